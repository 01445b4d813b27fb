#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "study/calibrate/fit_report.h"
#include "study/record/json_number.h"

namespace linkstudy::calibration {
namespace {

using Json = nlohmann::ordered_json;

Json json_interval(const Interval& interval) {
  return Json::array({json_number(interval.low), json_number(interval.high)});
}

Json json_parameters(const FitReport& report) {
  Json parameters = Json::object();
  for (std::size_t i = 0; i < report.fit.estimates.size(); ++i) {
    const Estimate& one = report.fit.estimates[i];
    const FitParameter& parameter = report.fit.problem.parameters[i];
    parameters[parameter.name] = {{"value", json_number(one.value)},
                                  {"unit", parameter.unit},
                                  {"interval", json_interval(one.profile)},
                                  {"linear_interval", json_interval(one.linear)},
                                  {"standard_error", json_number(one.standard_error)},
                                  {"identifiability", name_of(one.identifiability)},
                                  {"combination", one.combination},
                                  {"at_bound", name_of(one.at_bound)}};
  }
  return parameters;
}

Json json_others(const FitReport& report) {
  Json others = Json::object();
  for (const OtherValue& one : report.others) {
    others[one.name] = {{"value", json_number(one.value)}, {"unit", one.unit}, {"role", one.role}};
  }
  return others;
}

Json json_correlations(const FitResult& fit) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < fit.correlation.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index k = 0; k < fit.correlation.cols(); ++k) {
      row.push_back(json_number(fit.correlation(i, k)));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

Json json_data(const FitReport& report) {
  Json data = Json::array();
  for (std::size_t i = 0; i < report.fit.figures.series.size(); ++i) {
    const SeriesFigures& one = report.fit.figures.series[i];
    data.push_back({{"experiment", report.data.at(i).experiment},
                    {"channel", report.data[i].channel},
                    {"samples", report.data[i].times.size()},
                    {"weighted_rms", json_number(one.rms)},
                    {"autocorrelation", json_number(one.autocorrelation)},
                    {"effective_samples", json_number(one.effective)}});
  }
  return data;
}

std::size_t count_best(const FitResult& fit) {
  return static_cast<std::size_t>(
      std::ranges::count_if(fit.starts, [](const StartReport& one) { return one.is_best; }));
}

std::size_t count_failed_starts(const FitResult& fit) {
  return static_cast<std::size_t>(
      std::ranges::count(fit.starts, DescentEnd::start_failed, &StartReport::end));
}

}  // namespace

std::string write_verdict(const FitReport& report) {
  const FitResult& fit = report.fit;
  std::string text = std::string(name_of(fit.status));
  if (fit.status == FitStatus::failed) return fmt::format("{}: {}\n", text, fit.reason);
  text += fmt::format(": {} values, {:.0f} samples ({:.4g} effective), weighted rms {:.4g}\n",
                      fit.estimates.size(), fit.figures.samples, fit.figures.effective,
                      std::sqrt(fit.sum / std::max(1.0, fit.figures.samples)));
  if (!fit.reason.empty()) text += fmt::format("  but {}\n", fit.reason);
  for (const std::string& one : fit.flat) {
    text += fmt::format("  changes nothing: {}\n", one);
  }
  text += fmt::format(
      "  {} of {} starts end here{}; {} {}; {} evaluations in {} rounds, {} failed\n",
      count_best(fit), fit.starts.size(),
      count_failed_starts(fit) > 0 ? fmt::format(" ({} failed)", count_failed_starts(fit))
                                   : std::string(),
      fit.check.algorithm,
      !fit.check.ran       ? "did not run"
      : fit.check.confirms ? "confirms"
                           : "does not confirm",
      fit.evaluations, fit.rounds, fit.failed);
  return text;
}

std::string write_json(const FitReport& report, const std::string& digest) {
  const FitResult& fit = report.fit;
  const Json json = {{"status", name_of(fit.status)},
                     {"reason", fit.reason},
                     {"parameters", json_parameters(report)},
                     {"others", json_others(report)},
                     {"correlations", json_correlations(fit)},
                     {"flat", fit.flat},
                     {"sum_of_squares", json_number(fit.sum)},
                     {"samples", static_cast<std::int64_t>(fit.figures.samples)},
                     {"effective_samples", json_number(fit.figures.effective)},
                     {"data", json_data(report)},
                     {"starts",
                      {{"made", fit.starts.size()},
                       {"at_best", count_best(fit)},
                       {"failed", count_failed_starts(fit)}}},
                     {"check",
                      {{"algorithm", fit.check.algorithm},
                       {"confirms", fit.check.confirms},
                       {"ended", fit.check.ended}}},
                     {"evaluation", fit.evaluation},
                     {"evaluations", fit.evaluations},
                     {"failed", fit.failed},
                     {"rounds", fit.rounds},
                     {"digest", digest}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace linkstudy::calibration
