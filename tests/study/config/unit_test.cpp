#include "study/config/unit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "study/config/key.h"

namespace linkstudy {
namespace {

double in(const std::string& text, const std::string& unit) {
  const std::optional<WrittenQuantity> quantity = split_quantity(text);
  if (!quantity) return std::nan("");
  const std::optional<Unit> from = parse_unit(quantity->unit), to = parse_unit(unit);
  if (!from || !to) return std::nan("");
  return convert_unit(quantity->value, *from, *to).value_or(std::nan(""));
}

TEST(Unit, Quantities_convert_to_SI) {
  EXPECT_DOUBLE_EQ(in("60 deg", "rad"), std::numbers::pi / 3.0);
  EXPECT_DOUBLE_EQ(in("80 mm", "m"), 0.08);
  EXPECT_DOUBLE_EQ(in("1e6 N/m", "N/m"), 1.0e6);
  EXPECT_DOUBLE_EQ(in("10 N m", "N m"), 10.0);
  EXPECT_DOUBLE_EQ(in("10 kNm", "N m"), 1.0e4);
  EXPECT_DOUBLE_EQ(in("5 g/cm^3", "kg/m^3"), 5000.0);
  EXPECT_DOUBLE_EQ(in("1500 rpm", "rad/s"), 50.0 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(in("5 mm/rev", "m/rev"), 0.005);
  EXPECT_DOUBLE_EQ(in("210 GPa", "N/m^2"), 2.1e11);
  EXPECT_DOUBLE_EQ(in("2 min", "s"), 120.0);
  EXPECT_DOUBLE_EQ(in("36 km/h", "m/s"), 10.0);
  EXPECT_DOUBLE_EQ(in("20 %", ""), 0.2);
  EXPECT_DOUBLE_EQ(in("7 \u00B5m", "m"), 7.0e-6);
  EXPECT_DOUBLE_EQ(in("3 t", "kg"), 3000.0);
}

TEST(Unit, Products_powers_and_brackets_are_understood) {
  EXPECT_DOUBLE_EQ(in("2 m s^-2", "m/s^2"), 2.0);
  EXPECT_DOUBLE_EQ(in("2 m/s/s", "m/s^2"), 2.0);
  EXPECT_DOUBLE_EQ(in("2 m\u00B2", "m^2"), 2.0);
  EXPECT_DOUBLE_EQ(in("2 kg*m^2/(s^2 rad)", "N m/rad"), 2.0);
  EXPECT_DOUBLE_EQ(in("3 N/m s", "N s/m"), 3.0);
  EXPECT_DOUBLE_EQ(in("100 1/s", "Hz"), 100.0);
  EXPECT_DOUBLE_EQ(in("2 (N m)^2", "N^2 m^2"), 2.0);
}

TEST(Unit, Other_dimensions_are_refused) {
  EXPECT_TRUE(std::isnan(in("5 kg", "m")));
  EXPECT_TRUE(std::isnan(in("60 deg", "m")));
  EXPECT_TRUE(std::isnan(in("60 deg", "")));
  EXPECT_TRUE(std::isnan(in("5 1/s", "rad/s")));
  EXPECT_TRUE(std::isnan(in("10 N m", "N m/rad")));
}

TEST(Unit, Nonsense_is_no_unit) {
  for (const char* text : {"furlong", "m^", "m^x", "m^99", "(m", "m)", "m//s", "^2", "kmm", "/",
                           "m %%", "\xC3", "((((((((((((((((((((m))))))))))))))))))))"}) {
    EXPECT_FALSE(parse_unit(text)) << text;
  }
  std::string fault;
  EXPECT_FALSE(parse_unit("N furlong", &fault));
  EXPECT_EQ(fault, "'furlong'");
}

TEST(Unit, Numbers_that_are_not_finite_are_no_quantities) {
  for (const char* text : {"", "m", "nan m", "inf m", "1e999 m", "- 5 m", "+-5 m"}) {
    EXPECT_FALSE(split_quantity(text)) << text;
  }
  EXPECT_EQ(split_quantity(" +5e-1mm ")->value, 0.5);
  EXPECT_EQ(split_quantity(" +5e-1mm ")->unit, "mm");
}

TEST(Unit, Every_unit_of_the_key_tables_parses_and_is_SI_or_per_revolution) {
  for (const auto* rows : {&model_rows(), &study_rows(), &tune_rows()}) {
    for (const KeyRow& row : *rows) {
      for (const std::string& text : unit_alternatives(row.unit)) {
        const std::optional<Unit> unit = parse_unit(text);
        ASSERT_TRUE(unit) << row.path;
        const double factor = text == "m/rev" ? 0.5 / std::numbers::pi : 1.0;
        EXPECT_DOUBLE_EQ(unit->factor, factor) << row.path;
      }
    }
  }
}

}  // namespace
}  // namespace linkstudy
