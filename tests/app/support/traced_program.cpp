// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "app/support/traced_program.hpp"

#include <fcntl.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>

namespace swiftlet::test {
namespace {

constexpr std::array kChanging{
#ifdef SYS_rename  // newer machines have the ...at calls only
    SYS_rename,    SYS_link,      SYS_unlink,   SYS_mkdir,
#endif
    SYS_renameat2, SYS_linkat,    SYS_unlinkat, SYS_mkdirat,   SYS_pwrite64,
    SYS_ftruncate, SYS_fallocate, SYS_fsync,    SYS_fdatasync,
};

bool changes_a_file(const __ptrace_syscall_info& call) {
  const auto number = static_cast<long>(call.entry.nr);
  if (number == SYS_openat) return (call.entry.args[2] & O_CREAT) != 0;
  if (number == SYS_write) return call.entry.args[0] > STDERR_FILENO;
  return std::ranges::find(kChanging, number) != kChanging.end();
}

[[noreturn]] void become_traced(std::vector<char*> words, const std::filesystem::path& folder) {
  const int nowhere = open("/dev/null", O_RDWR);
  if (chdir(folder.c_str()) != 0 || dup2(nowhere, STDOUT_FILENO) < 0 ||
      dup2(nowhere, STDERR_FILENO) < 0)
    _exit(126);
  setenv("ASAN_OPTIONS", "detect_leaks=0",
         1);  // the search for leaks is a tracer, too, and there is one
  if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(125);
  std::raise(SIGSTOP);  // until the options are set
  execv(SWIFTLET_PROGRAM, words.data());
  _exit(127);
}

/// Whether the thread stands before a call that changes a file.
bool is_before_change(pid_t thread) {
  __ptrace_syscall_info call{};
  void* const size = reinterpret_cast<void*>(sizeof(call));
  return ptrace(PTRACE_GET_SYSCALL_INFO, thread, size, &call) > 0 &&
         call.op == PTRACE_SYSCALL_INFO_ENTRY && changes_a_file(call);
}

/// Lets all threads run from call to call until the program is over.
TracedRun follow(pid_t program, int n) {
  TracedRun run;
  int status = 0;
  for (pid_t thread = 0; (thread = waitpid(-1, &status, __WALL)) > 0 || errno == EINTR;) {
    if (thread < 0) continue;
    if (!WIFSTOPPED(status)) {
      if (thread == program) {
        run.was_killed = WIFSIGNALED(status);
        run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
      }
      continue;  // the loop ends when there is no child left
    }
    const bool is_call = WSTOPSIG(status) == (SIGTRAP | 0x80);
    if (is_call && is_before_change(thread) && ++run.calls == n) {
      kill(program, SIGKILL);
      continue;
    }
    // What a clone or exec reports, and the first stop of a new thread, are no signals to pass on.
    const bool is_signal = !is_call && WSTOPSIG(status) != SIGTRAP && WSTOPSIG(status) != SIGSTOP;
    const long signal = is_signal ? WSTOPSIG(status) : 0;
    ptrace(PTRACE_SYSCALL, thread, nullptr, reinterpret_cast<void*>(signal));
  }
  return run;
}

}  // namespace

std::optional<TracedRun> run_until_call(const std::vector<std::string>& arguments,
                                        const std::filesystem::path& folder, int n) {
  std::vector<std::string> words{SWIFTLET_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t program = fork();
  if (program == 0) become_traced(std::move(pointers), folder);
  int status = 0;
  if (waitpid(program, &status, 0) != program || !WIFSTOPPED(status)) return std::nullopt;
  constexpr long kOptions = PTRACE_O_TRACESYSGOOD | PTRACE_O_TRACECLONE | PTRACE_O_TRACEFORK |
                            PTRACE_O_TRACEVFORK | PTRACE_O_EXITKILL;
  ptrace(PTRACE_SETOPTIONS, program, nullptr, reinterpret_cast<void*>(kOptions));
  ptrace(PTRACE_SYSCALL, program, nullptr, nullptr);
  return follow(program, n);
}

}  // namespace swiftlet::test
