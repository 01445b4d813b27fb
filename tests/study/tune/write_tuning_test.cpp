#include "study/tune/write_tuning.h"

#include <nlohmann/json.hpp>
#include <set>

#include "study/tune/tuning_tables.h"
#include "synthetic_error.h"

namespace linkstudy::tuning::write_tuning_test {
namespace {

using nlohmann::json;
using testing::SyntheticError;

TuningResult tune_feasible() {
  SyntheticError model;
  return tune(model.problem(), {}, model.evaluator());
}

TuningResult tune_infeasible() {
  SyntheticError model;
  model.terms = {{2e4, 1e6}};
  model.cause = [](double c, double) { return c > 1e7 ? Cause::diverged : Cause::ok; };
  return tune(model.problem(), {}, model.evaluator());
}

// [A-Za-z][A-Za-z0-9_]*
bool is_legal(const std::string& name) {
  const auto letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); };
  return !name.empty() && letter(name.front()) &&
         std::all_of(name.begin(), name.end(),
                     [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_'; });
}

TEST(TuningJson, Has_every_key_of_the_interface) {
  const TuningResult result = tune_feasible();
  const json object = json::parse(write_json(result, "abc"));
  EXPECT_EQ(object.at("status"), "certified");
  EXPECT_EQ(object.at("parameters").at("closure.S.sde.stiffness"), result.point[0]);
  EXPECT_EQ(object.at("objective"), std::log10(result.point[0]));
  EXPECT_EQ(object.at("error").at("force.0"), result.answer.errors[0]);
  EXPECT_EQ(object.at("window").at("low"), result.point[0]);
  EXPECT_EQ(object.at("window").at("high"), result.window->high);
  EXPECT_EQ(object.at("window").at("high_limited_by"), "accuracy");
  EXPECT_GT(object.at("window").at("margin_decades"), 2.0);
  for (const std::string claim : {"C0", "C1", "C2", "C3"}) {
    EXPECT_EQ(object.at("certificate").at(claim).at("verdict"), "certified") << claim;
    EXPECT_FALSE(object.at("certificate").at(claim).at("evaluations").empty()) << claim;
  }
  EXPECT_EQ(object.at("evaluations"), result.observations.size());
  EXPECT_EQ(object.at("rounds"), result.rounds);
  EXPECT_EQ(object.at("digest"), "abc");
}

TEST(TuningJson, Has_nulls_and_a_suggestion_where_nothing_matches) {
  const json object = json::parse(write_json(tune_infeasible(), ""));
  EXPECT_EQ(object.at("status"), "infeasible");
  EXPECT_TRUE(object.at("window").is_null());
  EXPECT_TRUE(object.at("certificate").is_null());
  EXPECT_TRUE(object.at("objective").is_null());
  EXPECT_GT(object.at("suggestion").at("step"), 0.0);
  EXPECT_NE(object.at("suggestion").at("message").get<std::string>().find("step <="),
            std::string::npos);
}

TEST(TuningText, Shows_what_a_user_asks_for) {
  const std::string text = write_text(tune_feasible());
  for (const std::string part :
       {"status      certified", "closure.S.sde.stiffness = 100", "above limited by accuracy",
        "binding     force.0", "h omega_max", "C0          certified", "C3          certified",
        "NLopt       COBYLA: nothing lower", "too soft", "step too coarse", "evaluations in"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
}

TEST(TuningText, Shows_the_damping_beside_the_answer_and_so_do_the_tables) {
  TuningResult result = tune_feasible();
  EXPECT_EQ(write_text(result).find("damping"), std::string::npos);
  result.answer.derived = {{"closure.S.sde.damping_ratio", "", {0.7}},
                           {"closure.S.sde.damping", "N s/m", {564.663}}};
  EXPECT_NE(write_text(result).find("damping     closure.S.sde.damping_ratio = 0.7\n"
                                    "            closure.S.sde.damping = 564.663 N s/m\n"),
            std::string::npos)
      << write_text(result);
  const json derived = json::parse(write_json(result, "")).at("derived");
  EXPECT_EQ(derived.at("closure.S.sde.damping").at("value"), 564.663);
  EXPECT_EQ(derived.at("closure.S.sde.damping").at("unit"), "N s/m");
  const std::vector<Table> tables = make_tables(result);
  const Column* column = find_column(tables.front(), "closure.S.sde.damping");
  ASSERT_NE(column, nullptr);
  EXPECT_EQ(column->unit, "N s/m");
  EXPECT_EQ(std::get<std::vector<double>>(column->values), std::vector<double>{564.663});
}

TEST(TuningText, Shows_the_side_of_every_failing_point_of_an_empty_window) {
  const std::string text = write_text(tune_infeasible());
  for (const std::string part :
       {"infeasible", "use step <=", "too soft", "step too coarse", "diverged"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
}

TEST(TuningTables, Have_legal_names_and_columns_of_one_length) {
  for (const TuningResult& result : {tune_feasible(), tune_infeasible()}) {
    std::set<std::string> names;
    for (const Table& table : make_tables(result)) {
      EXPECT_TRUE(is_legal(table.name));
      names.insert(table.name);
      EXPECT_NO_THROW(row_count(table)) << table.name;
      for (const Column& column : table.columns) EXPECT_TRUE(is_legal(column.name)) << column.name;
    }
    EXPECT_EQ(names, (std::set<std::string>{"certificate", "components", "evaluations", "result",
                                            "scan"}));
  }
}

TEST(TuningTables, Hold_every_evaluation_in_the_order_asked) {
  const TuningResult result = tune_feasible();
  const Table table = make_tables(result).back();
  ASSERT_EQ(table.name, "evaluations");
  const auto& ids = std::get<std::vector<std::int64_t>>(table.columns.front().values);
  ASSERT_EQ(ids.size(), result.observations.size());
  for (std::size_t i = 0; i < ids.size(); ++i) EXPECT_EQ(ids[i], static_cast<std::int64_t>(i));
}

}  // namespace
}  // namespace linkstudy::tuning::write_tuning_test
