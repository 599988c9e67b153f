// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace swiftlet::test {

/// How the built program ended and what it said.
struct Ended {
  int exit_code = -1;  ///< 128 + signal if a signal ended it, as in a shell
  std::string out;
  std::string err;
};

/// The built program `swiftlet`, running in a folder, with pipes at its standard output and error.
class RunningProgram {
 public:
  /// `file_limit_bytes`: no file may grow beyond it, which is what a full disk looks like; 0 =
  /// none.
  RunningProgram(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                 std::uint64_t file_limit_bytes = 0);
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;
  ~RunningProgram();

  /// Waits until a file of the folder exists; false if the program ended before that.
  [[nodiscard]] bool wait_for_file(const std::string& name);
  void send(int signal) const;
  [[nodiscard]] Ended wait();

 private:
  bool has_ended(int options);

  std::filesystem::path folder_;
  pid_t process_ = -1;
  int out_ = -1;  // our ends of the pipes
  int err_ = -1;
  int status_ = 0;
  bool is_over_ = false;
};

/// Runs it to its end.
[[nodiscard]] Ended run(const std::vector<std::string>& arguments,
                        const std::filesystem::path& folder, std::uint64_t file_limit_bytes = 0);

/// Runs it to its end, which must be a good one, and reads what it says as JSON.
[[nodiscard]] nlohmann::json run_for_json(const std::vector<std::string>& arguments,
                                          const std::filesystem::path& folder);

}  // namespace swiftlet::test
