// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/base/contract.hpp"

#include <fmt/core.h>

#include <cstdlib>

namespace swiftlet {
namespace {

void print_and_abort(const char* condition, const char* message, const char* file, int line) {
  fmt::print(stderr, "swiftlet: {}:{}: broken contract: {} ({})\n", file, line, message, condition);
  std::abort();
}

ContractHandler handler = print_and_abort;

}  // namespace

ContractHandler set_contract_handler(ContractHandler replacement) {
  const ContractHandler old = handler;
  handler = replacement;
  return old;
}

void contract_broken(const char* condition, const char* message, const char* file, int line) {
  handler(condition, message, file, line);
  std::abort();
}

}  // namespace swiftlet
