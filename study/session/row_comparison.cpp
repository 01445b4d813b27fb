#include "study/session/row_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "study/config/tree_content.h"
#include "study/metrics/invalid_point.h"
#include "study/session/stored_evaluator.h"
#include "study/session/study_points.h"

namespace linkstudy {
namespace {

bool same_paths(const std::vector<Parameter>& a, const std::vector<Parameter>& b) {
  return std::ranges::equal(a, b, {}, &Parameter::path, &Parameter::path);
}

// The study without what keys of cases tell, and without how it is run.
Tree without_models(Tree study) {
  for (const char* key : {"base", "run", "name", "model"}) study.erase(key);
  if (Tree* reference = study.find("reference")) reference->erase("set");
  for (const char* list : {"load_case", "experiment"}) {
    Tree* entries = study.find(list);
    if (entries == nullptr) continue;
    for (Tree& entry : entries->items) {
      entry.erase("set");
      if (Tree* reference = entry.find("reference")) reference->erase("set");
    }
  }
  return study;
}

std::string shown_value(const Value& value) {
  if (const double* number = std::get_if<double>(&value)) return fmt::format("{:.9g}", *number);
  return std::get<std::string>(value);
}

// "closure.S.sde.stiffness = 30000 N/m, simulation.step = 0.001 s"
std::string shown_point(const std::vector<Parameter>& parameters, const Point& point) {
  std::string text;
  for (std::size_t i = 0; i < parameters.size() && i < point.values.size(); ++i) {
    text += fmt::format("{}{} = {}{}{}", i == 0 ? "" : ", ", parameters[i].path,
                        shown_value(point.values[i]), parameters[i].unit.empty() ? "" : " ",
                        parameters[i].unit);
  }
  return text;
}

std::string shown_difference(const char* what, const ContentDifference& one) {
  return fmt::format("{}: '{}' was {}, now {}", what, one.path, one.first, one.second);
}

class Beside {
 public:
  Beside(const EarlierStudy& before, const Evaluator& now)
      : before_(before), now_(now), keys_(now), input_(now.input()) {}

  RowComparison run() {
    if (before_.evaluator->input().kind != input_.kind) {
      found_.lost = fmt::format("it is a {}", name_of(before_.evaluator->input().kind));
      return found_;
    }
    found_.asks_the_same = !find_difference(without_models(before_.evaluator->input().resolved),
                                            without_models(input_.resolved));
    same_parameters_ = same_paths(before_.evaluator->parameters(), now_.parameters());
    if (has_design(input_.kind)) {
      compare_with_design();
    } else {
      compare_with_search();
    }
    return found_;
  }

 private:
  void compare_with_design() {
    points_ = points_of(input_);
    std::unordered_map<std::string, CaseKey> places;
    for (const Point& point : points_) {
      if (const auto key = keys_.of(point.values)) places.emplace(key->digest, *key);
    }
    found_.is_in_place = same_parameters_;
    for (const Evaluation& row : before_.results.evaluations) {
      found_.is_in_place = found_.is_in_place && is_in_place(row.point);
      const std::optional<CaseKey> key = before_.keys.of(row.point.values);
      if (!key) continue;  // an invalid point costs nothing
      const auto place = places.find(key->digest);
      if (place == places.end()) return lose(row);
      keep(row, *key, place->second);
    }
  }

  bool is_in_place(const Point& point) const {
    return point.id < points_.size() && points_[point.id].values == point.values;
  }

  void compare_with_search() {
    if (!same_parameters_) {
      found_.lost = "it searches other values";
      return;
    }
    if (!check_ranges()) return;
    for (const Evaluation& row : before_.results.evaluations) {
      const std::optional<CaseKey> key = before_.keys.of(row.point.values);
      if (!key) continue;
      const std::optional<CaseKey> own = keys_.of(row.point.values);
      if (!own || own->digest != key->digest) return lose(row);
      keep(row, *key, *own);
    }
  }

  bool check_ranges() {
    const auto is_within = [&](const auto& before, const auto& now) {
      for (std::size_t i = 0; i < std::min(before.size(), now.size()); ++i) {
        if (now[i].low <= before[i].low && now[i].high >= before[i].high) continue;
        found_.lost = fmt::format("the range of '{}' was [{:.9g}, {:.9g}], now [{:.9g}, {:.9g}]",
                                  now[i].parameter.path, before[i].low, before[i].high, now[i].low,
                                  now[i].high);
        return false;
      }
      return true;
    };
    const StudyInput& before = before_.evaluator->input();
    return is_within(before.tune, input_.tune) && is_within(before.calibrated, input_.calibrated);
  }

  void keep(const Evaluation& row, const CaseKey& before, const CaseKey& now) {
    ++found_.kept;
    const CapChange change = compare_caps(before, now);
    if (change == CapChange::narrower || found_.caps == CapChange::none) found_.caps = change;
    if (is_ended_by_caps(row.status, before, now)) found_.ended_by_caps.push_back(row.point.id);
  }

  void lose(const Evaluation& row) {
    found_.lost = fmt::format("row {} is none of it ({})", row.point.id, why_lost(row));
  }

  std::string why_lost(const Evaluation& row) const {
    if (const auto one = find_difference(before_.keys.kept(), keys_.kept())) {
      return shown_difference("other things are kept of a run", *one);
    }
    if (same_parameters_) {
      if (const std::string why = why_another_model(row); !why.empty()) return why;
    }
    if (const auto one = find_difference(before_.keys.references(), keys_.references())) {
      return shown_difference("it is compared with another run", *one);
    }
    if (!same_parameters_) return without_place(row);
    const auto own = keys_.of(row.point.values);
    const bool is_same = own && own->digest == before_.keys.of(row.point.values)->digest;
    return is_same ? without_place(row) : "it is compared with other data";
  }

  std::string why_another_model(const Evaluation& row) const {
    try {
      for (std::size_t i = 0; i < now_.load_case_count(); ++i) {
        const auto one = find_difference(before_.evaluator->model_at(i, row.point.values).resolved,
                                         now_.model_at(i, row.point.values).resolved);
        if (one) return shown_difference("the model is another", *one);
      }
      return {};
    } catch (const InvalidPoint& error) {
      return error.what();
    }
  }

  std::string without_place(const Evaluation& row) const {
    return fmt::format("no point is at {}",
                       shown_point(before_.evaluator->parameters(), row.point));
  }

  const EarlierStudy& before_;
  const Evaluator& now_;
  CaseKeys keys_;
  const StudyInput& input_;
  std::vector<Point> points_;
  bool same_parameters_ = false;
  RowComparison found_;
};

}  // namespace

EarlierStudy::EarlierStudy(StudyResults stored)
    : results(std::move(stored)), evaluator(make_stored_evaluator(results)), keys(*evaluator) {}

RowComparison compare_rows(const EarlierStudy& before, const Evaluator& now) {
  return Beside(before, now).run();
}

}  // namespace linkstudy
