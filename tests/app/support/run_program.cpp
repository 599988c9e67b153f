// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "app/support/run_program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "support/temp_folder.hpp"

namespace swiftlet::test {
namespace {

constexpr const char* kOut = ".stdout";
constexpr const char* kErr = ".stderr";

void redirect(int descriptor, const char* file) {
  const int opened = open(file, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(126);
}

[[noreturn]] void become_program(std::vector<char*> words, const std::filesystem::path& folder,
                                 std::uint64_t file_limit_bytes) {
  if (chdir(folder.c_str()) != 0) _exit(126);
  redirect(STDOUT_FILENO, kOut);
  redirect(STDERR_FILENO, kErr);
  if (file_limit_bytes > 0) {
    const rlimit limit{file_limit_bytes, file_limit_bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_IGN);  // then write() fails, as on a full disk
  }
  execv(SWIFTLET_PROGRAM, words.data());
  _exit(127);
}

}  // namespace

RunningProgram::RunningProgram(const std::vector<std::string>& arguments,
                               const std::filesystem::path& folder, std::uint64_t file_limit_bytes)
    : folder_(folder) {
  std::vector<std::string> words{SWIFTLET_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  process_ = fork();
  if (process_ == 0) become_program(std::move(pointers), folder, file_limit_bytes);
}

RunningProgram::~RunningProgram() {
  if (is_over_) return;
  send(SIGKILL);
  has_ended(0);
}

bool RunningProgram::has_ended(int options) {
  if (!is_over_) is_over_ = waitpid(process_, &status_, options) == process_;
  return is_over_;
}

bool RunningProgram::wait_for_file(const std::string& name) {
  using namespace std::chrono_literals;
  while (!std::filesystem::exists(folder_ / name)) {
    if (has_ended(WNOHANG)) return std::filesystem::exists(folder_ / name);
    std::this_thread::sleep_for(1ms);  // polls another process; no test result depends on it
  }
  return true;
}

void RunningProgram::send(int signal) const { kill(process_, signal); }

Ended RunningProgram::wait() {
  has_ended(0);
  const int code = WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
  return {code, content_of(folder_ / kOut), content_of(folder_ / kErr)};
}

Ended run(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
          std::uint64_t file_limit_bytes) {
  return RunningProgram(arguments, folder, file_limit_bytes).wait();
}

}  // namespace swiftlet::test
