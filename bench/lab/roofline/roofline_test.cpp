// SPDX-License-Identifier: MIT
#include "lab/roofline/roofline.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace estampe::lab::roofline {
namespace {

constexpr Ceilings ceilings{.bytes_a_s = 1e9, .operations_a_s = 4e9};

TEST(Roofline, SharesAreOfTheCeilings)
{
    const PassCost pass{.name = "light", .ms = {1.0, 2.0, 3.0}, .bytes = 500'000, .operations = 2'000'000};
    EXPECT_DOUBLE_EQ(share_of_copy(pass, ceilings), 0.25);        // 0.5 MB in 2 ms, of 1 GB/s
    EXPECT_DOUBLE_EQ(*share_of_arithmetic(pass, ceilings), 0.25); // 2 M in 2 ms, of 4 G/s
    EXPECT_FALSE(share_of_arithmetic({.name = "list", .ms = {1, 1, 1}, .bytes = 1}, ceilings).has_value());
}

TEST(Roofline, TablesSayAllThatWasMeasured)
{
    const Result result{
        .device = "a device",
        .driver = "a driver",
        .software = false,
        .width = 64,
        .height = 32,
        .frames = 3,
        .ceilings = ceilings,
        .pictures = {{.name = "field",
                      .about = "A field",
                      .ms = 4.0,
                      .passes = {{.name = "light",
                                  .ms = {1.0, 2.0, 3.0},
                                  .share = 0.5,
                                  .bytes = 500'000,
                                  .operations = 2'000'000},
                                 {.name = "list", .ms = {1, 1, 1}, .share = 0.25, .bytes = 1000}}}}};
    const std::string text = text_of(result);
    EXPECT_NE(text.find("copies 1 GB/s"), std::string::npos) << text;
    EXPECT_NE(text.find("2.0000   50.0      0.50     25.0      2.00     25.0\n"), std::string::npos) << text;
    EXPECT_NE(text.find("1.0000   25.0      0.00      0.1         -        -\n"), std::string::npos) << text;
    const auto json = nlohmann::json::parse(json_of(result));
    EXPECT_EQ(json["pictures"][0]["passes"][0]["share_of_arithmetic"], 0.25);
    EXPECT_FALSE(json["pictures"][0]["passes"][1].contains("operations"));
    EXPECT_NE(csv_of(result).find("field,\"light\",2,0.5,500000,0.25,2000000,0.25\n"), std::string::npos);
    EXPECT_NE(csv_of(result).find("field,\"list\",1,0.25,1000,0.001,,\n"), std::string::npos);
}

} // namespace
} // namespace estampe::lab::roofline
