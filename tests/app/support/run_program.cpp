// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "app/support/run_program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <thread>

namespace swiftlet::test {
namespace {

std::array<int, 2> make_pipe() {
  std::array<int, 2> ends{-1, -1};
  EXPECT_EQ(pipe2(ends.data(), O_CLOEXEC), 0);
  return ends;
}

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> buffer;
  for (ssize_t n = 0; (n = read(descriptor, buffer.data(), buffer.size())) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(n));
  }
  return text;
}

[[noreturn]] void become_program(std::vector<char*> words, const std::filesystem::path& folder,
                                 std::uint64_t file_limit_bytes, int out, int err) {
  if (chdir(folder.c_str()) != 0) _exit(126);
  if (dup2(out, STDOUT_FILENO) < 0 || dup2(err, STDERR_FILENO) < 0) _exit(126);
  if (file_limit_bytes > 0) {
    const rlimit limit{file_limit_bytes, file_limit_bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
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
  const auto out = make_pipe();
  const auto err = make_pipe();
  process_ = fork();
  if (process_ == 0) {
    become_program(std::move(pointers), folder, file_limit_bytes, out[1], err[1]);
  }
  close(out[1]);
  close(err[1]);
  out_ = out[0];
  err_ = err[0];
}

RunningProgram::~RunningProgram() {
  if (!is_over_) send(SIGKILL);
  has_ended(0);
  close(out_);
  close(err_);
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
  // What a command says fits a pipe, so the one that is read second never blocks the program.
  Ended ended{0, read_all(out_), read_all(err_)};
  has_ended(0);
  ended.exit_code = WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
  return ended;
}

Ended run(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
          std::uint64_t file_limit_bytes) {
  return RunningProgram(arguments, folder, file_limit_bytes).wait();
}

nlohmann::json run_for_json(const std::vector<std::string>& arguments,
                            const std::filesystem::path& folder) {
  const Ended ended = run(arguments, folder);
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  return nlohmann::json::parse(ended.out);
}

}  // namespace swiftlet::test
