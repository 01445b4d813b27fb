#include "study/config/unit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "study/config/key.h"

namespace linkstudy::unit_test {
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
  UnitFault fault;
  EXPECT_FALSE(parse_unit("N furlong", &fault));
  EXPECT_EQ(fault.part, "'furlong'");
  EXPECT_EQ(fault.hint, "");
}

// The same dimension, the exact factor: in, ft and lb of the agreement of 1959, standard gravity of
// the 3rd CGPM; psi = lbf/in^2 = 6894.757293168361... Pa (NIST SP 811, appendix B.8).
TEST(Unit, Customary_units_have_their_exact_size) {
  EXPECT_DOUBLE_EQ(in("1 in", "m"), 0.0254);
  EXPECT_DOUBLE_EQ(in("12 in", "ft"), 1.0);
  EXPECT_DOUBLE_EQ(in("1 ft", "m"), 0.3048);
  EXPECT_DOUBLE_EQ(in("1 lb", "kg"), 0.45359237);
  EXPECT_DOUBLE_EQ(in("1 lbm", "kg"), 0.45359237);
  EXPECT_DOUBLE_EQ(in("1 lbf", "N"), 0.45359237 * 9.80665);
  EXPECT_DOUBLE_EQ(in("1 kgf", "N"), 9.80665);
  EXPECT_DOUBLE_EQ(in("1 kp", "N"), 9.80665);
  EXPECT_DOUBLE_EQ(in("1 kip", "lbf"), 1000.0);
  EXPECT_DOUBLE_EQ(in("1 slug", "lbf s^2/ft"), 1.0);
  EXPECT_NEAR(in("1 slug", "kg"), 14.59390, 5e-6);  // as printed
  EXPECT_NEAR(in("1 psi", "Pa"), 6894.757293168361, 1e-11);
  EXPECT_DOUBLE_EQ(in("1 ksi", "psi"), 1000.0);
  EXPECT_DOUBLE_EQ(in("2 g0", "m/s^2"), 19.6133);
  EXPECT_DOUBLE_EQ(in("400 gon", "rev"), 1.0);
  EXPECT_NEAR(in("1 lbf.in", "N m"), 0.1129848290276167, 1e-15);  // NIST SP 811
}

TEST(Unit, Usual_spellings_mean_the_same) {
  for (const char* text : {"10 N m", "10 Nm", "10 N*m", "10 N.m", "10 N\u00B7m", "10 N\u22C5m",
                           "10 N-m", "10 J", "10000 Nmm", "1000 Ncm", "0.01 kN.m", "10 m N"}) {
    EXPECT_DOUBLE_EQ(in(text, "N m"), 10.0) << text;
  }
  for (const char* text : {"60 rpm", "60 RPM", "1 rev/s", "60 rev/min", "360 deg/s", "400 gon/s"}) {
    EXPECT_DOUBLE_EQ(in(text, "rad/s"), 2.0 * std::numbers::pi) << text;
  }
  for (const char* text : {"3 m/s^2", "3 m/s**2", "3 m/s\u00B2", "3 m.s^-2", "3 m s**-2"}) {
    EXPECT_DOUBLE_EQ(in(text, "m/s^2"), 3.0) << text;
  }
  EXPECT_DOUBLE_EQ(in("1 lbf-ft", "lbf ft"), 1.0);
  EXPECT_DOUBLE_EQ(in("5 kHz", "1/s"), 5000.0);
}

TEST(Unit, A_power_without_its_mark_is_refused_with_the_right_spelling) {
  UnitFault fault;
  EXPECT_FALSE(parse_unit("m/s2", &fault));
  EXPECT_EQ(fault.hint, "a power is written s^2");
  fault = {};
  EXPECT_FALSE(parse_unit("m s-1", &fault));
  EXPECT_EQ(fault.hint, "a power is written s^-1");
}

TEST(Unit, Words_and_wrong_capitals_lead_to_the_symbol) {
  const std::pair<const char*, const char*> cases[] = {
      {"milimeter", "mm"}, {"Millimetres", "mm"}, {"degrees", "deg"}, {"newtons", "N"},
      {"KN", "kN"},        {"hz", "Hz"},          {"Kg", "kg"},       {"inches", "in"},
      {"sec", "s"},        {"newtonmeter", "N m"}};
  for (const auto& [text, symbol] : cases) {
    UnitFault fault;
    EXPECT_FALSE(parse_unit(text, &fault)) << text;
    EXPECT_EQ(fault.hint, std::string("did you mean ") + symbol + "?") << text;
  }
  // Two symbols have these letters, a thousand million apart: no guess.
  UnitFault fault;
  EXPECT_FALSE(parse_unit("mpa", &fault));
  EXPECT_EQ(fault.hint, "");
}

TEST(Unit, A_rate_is_no_speed_of_turn_and_is_told_how_to_become_one) {
  const Unit rate = *parse_unit("Hz"), turn = *parse_unit("rad/s"), length = *parse_unit("m");
  EXPECT_FALSE(convert_unit(50.0, rate, turn));
  EXPECT_NE(explain_angle(rate, turn).find("rev/s"), std::string::npos);
  EXPECT_NE(explain_angle(*parse_unit("N m"), *parse_unit("N m/rad")).find("rad"),
            std::string::npos);
  EXPECT_EQ(explain_angle(rate, length), "");
}

TEST(Unit, Every_symbol_is_described) {
  const std::string text = describe_units();
  for (const UnitSymbol& symbol : unit_symbols()) {
    EXPECT_NE(text.find(" " + std::string(symbol.name) + " "), std::string::npos) << symbol.name;
    EXPECT_TRUE(parse_unit(symbol.name)) << symbol.name;
    EXPECT_TRUE(parse_unit(dimension_text(symbol.unit.dimensions))) << symbol.name;
    EXPECT_EQ(parse_unit(dimension_text(symbol.unit.dimensions))->dimensions,
              symbol.unit.dimensions);
  }
}

TEST(Unit, Numbers_that_are_not_finite_are_no_quantities) {
  for (const char* text : {"", "m", "nan m", "inf m", "1e999 m", "- 5 m", "+-5 m"}) {
    EXPECT_FALSE(split_quantity(text)) << text;
  }
  EXPECT_EQ(split_quantity(" +5e-1mm ")->value, 0.5);
  EXPECT_EQ(split_quantity(" +5e-1mm ")->unit, "mm");
}

TEST(Unit, Every_unit_of_the_key_tables_parses_and_is_SI_or_per_revolution) {
  for (const Word<FileKind>& kind : kWords<FileKind>) {
    for (const KeyRow& row : key_rows(kind.value)) {
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
}  // namespace linkstudy::unit_test
