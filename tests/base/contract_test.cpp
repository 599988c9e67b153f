// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/base/contract.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>

#include "swiftlet/base/narrow.hpp"

namespace swiftlet {
namespace {

TEST(Contract, that_holds_evaluates_its_condition_once) {
  int evaluated = 0;
  SWIFTLET_REQUIRE(++evaluated > 0, "counts");
  EXPECT_EQ(evaluated, 1);
}

TEST(ContractDeathTest, broken_names_the_condition_the_reason_and_the_place) {
  EXPECT_DEATH(SWIFTLET_REQUIRE(1 > 2, "one is more than two"),
               "contract_test.cpp:[0-9]+: broken contract: one is more than two \\(1 > 2\\)");
}

TEST(ContractDeathTest, aborts_even_if_the_handler_returns) {
  const ContractHandler old =
      set_contract_handler([](const char*, const char*, const char*, int) {});
  EXPECT_DEATH(SWIFTLET_REQUIRE(false, "never"), "");
  set_contract_handler(old);
}

TEST(Contract, handler_can_be_replaced_and_the_old_one_comes_back) {
  const ContractHandler mine = [](const char*, const char* message, const char*, int) {
    throw std::logic_error(message);
  };
  const ContractHandler old = set_contract_handler(mine);
  EXPECT_THROW(SWIFTLET_REQUIRE(false, "caught"), std::logic_error);
  EXPECT_EQ(set_contract_handler(old), mine);
}

TEST(Narrow, passes_what_fits_and_refuses_what_does_not) {
  EXPECT_EQ(to<std::uint8_t>(255), 255);
  EXPECT_EQ(to<std::int8_t>(-128), -128);
  EXPECT_DEATH((void)to<std::uint8_t>(256), "does not fit");
  EXPECT_DEATH((void)to<std::uint32_t>(-1), "does not fit");
  EXPECT_DEATH((void)to<std::int32_t>(std::uint32_t{0x80000000U}), "does not fit");
}

}  // namespace
}  // namespace swiftlet
