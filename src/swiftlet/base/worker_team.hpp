// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace swiftlet {

/// Threads that wait to share the work of their owner, who takes part in it.
///
/// Real time: run() neither allocates nor locks; workers sleep between calls. Thread safety: run()
/// from one thread at a time.
class WorkerTeam {
 public:
  /// `threads`: with the owner; 1 starts none. Where the system refuses one there are fewer, and
  /// threads() tells. REQUIRES: threads >= 1.
  explicit WorkerTeam(int threads);
  ~WorkerTeam();
  WorkerTeam(const WorkerTeam&) = delete;
  WorkerTeam& operator=(const WorkerTeam&) = delete;

  [[nodiscard]] int threads() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls work(worker) once on every thread, worker = 0 .. threads() - 1, and returns when all
  /// have returned. REQUIRES: work throws nothing.
  template <class Work>
  void run(Work&& work) {
    start([](void* context, int worker) { (*static_cast<Work*>(context))(worker); }, &work);
    work(0);
    finish();
  }

 private:
  using Call = void (*)(void* context, int worker);
  void start(Call call, void* context);
  void finish();
  void serve(int worker);

  Call call_ = nullptr;
  void* context_ = nullptr;
  std::atomic<std::uint32_t> round_{0};  // counts calls of run(); workers wait for the next
  std::atomic<std::uint32_t> busy_{0};   // workers that have not returned
  std::atomic<bool> is_closing_{false};
  std::vector<std::thread> workers_;
};

}  // namespace swiftlet
