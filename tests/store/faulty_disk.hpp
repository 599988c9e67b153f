// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <sqlite3.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <limits>

namespace swiftlet::test {

/// While it lives, all that SQLite writes in this process goes through it: it kills the process at
/// the n-th operation, or has room for so many bytes only. One at a time.
class FaultyDisk {
 public:
  FaultyDisk() : base_(sqlite3_vfs_find(nullptr)), vfs_(*base_) {
    current_ = this;
    vfs_.zName = "faulty";
    vfs_.szOsFile = static_cast<int>(sizeof(File)) + base_->szOsFile;
    vfs_.xOpen = open;
    vfs_.xDelete = remove;
    sqlite3_vfs_register(&vfs_, 1);
  }
  ~FaultyDisk() {
    sqlite3_vfs_register(base_, 1);
    sqlite3_vfs_unregister(&vfs_);
    current_ = nullptr;
  }
  FaultyDisk(const FaultyDisk&) = delete;
  FaultyDisk& operator=(const FaultyDisk&) = delete;

  int kill_at = std::numeric_limits<int>::max();                              ///< counts from 0
  std::atomic<std::int64_t> room = std::numeric_limits<std::int64_t>::max();  ///< bytes
  std::atomic<int> operations = 0;

 private:
  struct File {
    sqlite3_file self;
    [[nodiscard]] sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
  };
  static File& of(sqlite3_file* file) { return *reinterpret_cast<File*>(file); }
  template <class Member, class... Rest>
  static auto pass(Member member, sqlite3_file* file, Rest... rest) {
    sqlite3_file* real = of(file).real();
    return (real->pMethods->*member)(real, rest...);
  }
  static bool is_last() { return current_->operations++ == current_->kill_at; }
  static void count() {
    if (is_last()) std::raise(SIGKILL);
  }

  static int open(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* out) {
    count();
    std::memset(file, 0, sizeof(File));
    const int code = current_->base_->xOpen(current_->base_, name, of(file).real(), flags, out);
    if (of(file).real()->pMethods != nullptr) file->pMethods = &kMethods;
    return code;
  }
  static int remove(sqlite3_vfs*, const char* name, int sync) {
    count();
    return current_->base_->xDelete(current_->base_, name, sync);
  }
  static int close(sqlite3_file* f) { return pass(&sqlite3_io_methods::xClose, f); }
  static int read(sqlite3_file* f, void* to, int size, sqlite3_int64 at) {
    return pass(&sqlite3_io_methods::xRead, f, to, size, at);
  }
  static int write(sqlite3_file* f, const void* from, int size, sqlite3_int64 at) {
    if (is_last()) {  // torn in the middle
      pass(&sqlite3_io_methods::xWrite, f, from, size / 2, at);
      std::raise(SIGKILL);
    }
    sqlite3_int64 before = 0;  // what is written over takes no more room
    pass(&sqlite3_io_methods::xFileSize, f, &before);
    const std::int64_t growth = std::max<std::int64_t>(at + size - before, 0);
    if (current_->room < growth) return SQLITE_FULL;
    current_->room -= growth;
    return pass(&sqlite3_io_methods::xWrite, f, from, size, at);
  }
  static int truncate(sqlite3_file* f, sqlite3_int64 size) {
    count();
    return pass(&sqlite3_io_methods::xTruncate, f, size);
  }
  static int sync(sqlite3_file* f, int flags) {
    count();
    return pass(&sqlite3_io_methods::xSync, f, flags);
  }
  static int size(sqlite3_file* f, sqlite3_int64* out) {
    return pass(&sqlite3_io_methods::xFileSize, f, out);
  }
  static int lock(sqlite3_file* f, int kind) { return pass(&sqlite3_io_methods::xLock, f, kind); }
  static int unlock(sqlite3_file* f, int kind) {
    return pass(&sqlite3_io_methods::xUnlock, f, kind);
  }
  static int reserved(sqlite3_file* f, int* out) {
    return pass(&sqlite3_io_methods::xCheckReservedLock, f, out);
  }
  static int control(sqlite3_file* f, int what, void* value) {
    return pass(&sqlite3_io_methods::xFileControl, f, what, value);
  }
  static int sector(sqlite3_file* f) { return pass(&sqlite3_io_methods::xSectorSize, f); }
  static int traits(sqlite3_file* f) {
    return pass(&sqlite3_io_methods::xDeviceCharacteristics, f);
  }
  static int shm_map(sqlite3_file* f, int page, int size, int extend, void volatile** out) {
    return pass(&sqlite3_io_methods::xShmMap, f, page, size, extend, out);
  }
  static int shm_lock(sqlite3_file* f, int at, int n, int flags) {
    return pass(&sqlite3_io_methods::xShmLock, f, at, n, flags);
  }
  static void shm_barrier(sqlite3_file* f) { pass(&sqlite3_io_methods::xShmBarrier, f); }
  static int shm_unmap(sqlite3_file* f, int flag) {
    return pass(&sqlite3_io_methods::xShmUnmap, f, flag);
  }
  static constexpr sqlite3_io_methods kMethods{
      2,       close,  read,   write,   truncate, sync,        size,      lock,    unlock, reserved,
      control, sector, traits, shm_map, shm_lock, shm_barrier, shm_unmap, nullptr, nullptr};

  inline static FaultyDisk* current_ = nullptr;
  sqlite3_vfs* base_;
  sqlite3_vfs vfs_;
};

}  // namespace swiftlet::test
