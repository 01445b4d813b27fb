#include "study/converge/judge_convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/simulation/channel_kinds.h"
#include "study/config/precedence.h"
#include "study/config/value_path.h"
#include "study/converge/formal_order.h"
#include "study/converge/level_course.h"
#include "study/converge/series_difference.h"

namespace linkstudy::convergence {
namespace {

// What is judged alike: a number of every evaluation.
struct Quantity {
  std::string name;
  std::string unit;
  QuantityKind kind = QuantityKind::response;
  std::size_t index = 0;              // among the responses
  std::vector<std::size_t> siblings;  // components of the same vector, itself included
  std::optional<Reduction> reduce;    // of a response
  std::string load_case;
  double wanted = 0.0;
  double reference = kUnknown;
};

class Judging {
 public:
  Judging(const Evaluator& evaluator, const std::map<std::uint64_t, Evaluation>& evaluations,
          const FindHistories& find_histories)
      : evaluator_(evaluator),
        input_(evaluator.input()),
        evaluations_(evaluations),
        find_histories_(find_histories),
        cases_(split_responses(evaluator.responses())) {}

  Convergence run() {
    result_.name = input_.name;
    read_base();
    list_quantities();
    for (const LevelCourse& course : list_courses(input_)) {
      for (const Quantity& quantity : quantities_) judge_number(course, quantity);
      for (std::size_t i = 0; i < cases_.size(); ++i) judge_histories(course, i);
    }
    for (std::size_t axis = 0; axis < input_.vary.size(); ++axis) find_needed_of_all(axis);
    return std::move(result_);
  }

 private:
  // The model as it stands: its integrator, and the values that are refined.
  void read_base() {
    Diagnostics ignored;  // a model that is complete in its cases only has no values of its own
    const auto model = input_.model->with(case_overrides(input_, {}, {}), ignored);
    for (const VaryInput& vary : input_.vary) {
      const Tree* own =
          !model ? nullptr : find_value(model->resolved, model_schema(), vary.parameter.path);
      own_.push_back(own != nullptr && own->is_numeric() ? own->as_number() : kUnknown);
    }
    integrator_ = model ? model->options.integrator : Integrator::rk4;
  }

  double reference_of(std::size_t load_case, const std::string& response) const {
    if (!evaluator_.has_reference(load_case)) return kUnknown;
    const ReferenceRecord* record = evaluator_.known_reference(load_case);
    if (record == nullptr) return kUnknown;
    const auto found = std::ranges::find(record->responses, response, &Trace::name);
    return found == record->responses.end() ? kUnknown : found->values.front();
  }

  void list_quantities() {
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      list_errors(cases_[i]);
      list_responses_of(i);
    }
  }

  void list_errors(const StoredCase& one) {
    for (std::size_t m = 0; m < one.matches.size(); ++m) {
      const MatchInput& match = input_.match[m];
      const StoredErrors& errors = one.matches[m];
      const std::size_t first = match.norm == ErrorNorm::rms ? errors.rms : errors.max;
      for (std::size_t c = 0; c < errors.channels.size(); ++c) {
        Quantity quantity = quantity_at(first + c, QuantityKind::error, one);
        quantity.wanted = match.tolerance.front();
        quantities_.push_back(std::move(quantity));
      }
    }
  }

  // Components of one [[response]] follow each other and begin with its name.
  void list_responses_of(std::size_t load_case) {
    const StoredCase& one = cases_[load_case];
    const std::string prefix = one.load_case.empty() ? "" : one.load_case + "_";
    std::size_t at = 0;
    for (std::size_t r = 0; r < input_.response.size(); ++r) {
      const std::size_t count = evaluator_.signals().response[r].size();
      std::vector<std::size_t> siblings;
      for (std::size_t c = 0; c < count; ++c) siblings.push_back(one.responses.at(at + c));
      for (std::size_t c = 0; c < count; ++c) {
        Quantity quantity = quantity_at(siblings[c], QuantityKind::response, one);
        quantity.siblings = siblings;
        quantity.reduce = input_.response[r].reduce;
        quantity.wanted = input_.wanted_error;
        quantity.reference = reference_of(load_case, quantity.name.substr(prefix.size()));
        quantities_.push_back(std::move(quantity));
      }
      at += count * numbers_of_each(input_.response[r]);
    }
  }

  Quantity quantity_at(std::size_t index, QuantityKind kind, const StoredCase& one) const {
    const Response& response = evaluator_.responses().at(index);
    Quantity quantity;
    quantity.name = response.name;
    quantity.unit = response.unit == "1" ? "" : response.unit;
    quantity.kind = kind;
    quantity.index = index;
    quantity.load_case = one.load_case;
    return quantity;
  }

  const Evaluation& evaluation(std::uint64_t id) const { return evaluations_.at(id); }

  double value_of(std::uint64_t id, std::size_t response) const {
    const Evaluation& one = evaluation(id);
    return one.status == Cause::ok ? one.responses.at(response) : kUnknown;
  }

  QuantityLadder begin_ladder(const LevelCourse& course, const std::string& load_case) const {
    const VaryInput& vary = input_.vary[course.axis];
    QuantityLadder ladder;
    ladder.over = vary.parameter.path;
    ladder.over_unit = vary.parameter.unit;
    ladder.at = course.at;
    ladder.at_finest = course.at_finest;
    const auto stored = std::ranges::find(cases_, load_case, &StoredCase::load_case);
    const std::size_t steps = stored->always + static_cast<std::size_t>(RunNumber::steps);
    for (std::size_t i = 0; i < course.ids.size(); ++i) {
      const Evaluation& one = evaluation(course.ids[i]);
      const double taken = steps < one.responses.size() ? one.responses[steps] : kUnknown;
      ladder.levels.push_back({course.sizes[i], one.point.id, one.status, taken, one.wall_s});
    }
    return ladder;
  }

  RefinementOptions options_of(const LevelCourse& course,
                               const std::optional<Reduction>& reduce) const {
    const RefineInput& refine = input_.refine[course.axis];
    const std::string& path = input_.vary[course.axis].parameter.path;
    return {refine.formal_order.value_or(find_formal_order(path, integrator_, reduce)),
            input_.rounding};
  }

  void judge_number(const LevelCourse& course, const Quantity& quantity) {
    std::vector<Level> levels;
    double scale = quantity.kind == QuantityKind::error ? 1.0 : 0.0;
    for (std::size_t i = 0; i < course.ids.size(); ++i) {
      levels.push_back({course.h[i], value_of(course.ids[i], quantity.index)});
      for (const std::size_t sibling : quantity.siblings) {
        const double value = std::abs(value_of(course.ids[i], sibling));
        scale = value > scale ? value : scale;
      }
    }
    const bool is_error = quantity.kind == QuantityKind::error;
    std::optional<double> limit;
    if (is_error) limit = 0.0;
    if (!std::isnan(quantity.reference)) limit = quantity.reference;
    QuantityLadder ladder = begin_ladder(course, quantity.load_case);
    ladder.quantity = quantity.name;
    ladder.unit = quantity.unit;
    ladder.kind = quantity.kind;
    ladder.reference = quantity.reference;
    ladder.wanted = quantity.wanted;
    Ladder values = make_ladder(levels, limit, scale);
    values.is_relative = is_error;
    ladder.refinement = judge_refinement(values, options_of(course, quantity.reduce));
    remark_extremes(course, quantity, ladder.refinement);
    const double known = is_error ? 0.0 : ladder.refinement.extrapolated;
    const double wanted = is_error ? quantity.wanted : quantity.wanted * std::abs(known);
    for (Level& level : levels) level.value = std::abs(level.value - known);
    take_needed(ladder, course, levels, wanted);
    result_.ladders.push_back(std::move(ladder));
  }

  void remark_extremes(const LevelCourse& course, const Quantity& quantity,
                       Refinement& judged) const {
    const bool is_extreme = quantity.reduce == Reduction::max ||
                            quantity.reduce == Reduction::min ||
                            quantity.reduce == Reduction::max_abs;
    const bool is_step = input_.vary[course.axis].parameter.path == "simulation.step";
    if (!is_extreme || !is_step || judged.is_settled()) return;
    judged.remarks.emplace_back(
        "extremes lie between steps and scatter: judge the history "
        "([[series]]), or raise rounding");
  }

  void take_needed(QuantityLadder& ladder, const LevelCourse& course,
                   const std::vector<Level>& errors, double wanted) const {
    const NeededSize needed = find_needed_size(errors, wanted, ladder.refinement.order);
    ladder.needed_by = needed.by;
    ladder.needed = h_of_size(input_.refine[course.axis].limit, needed.h);
  }

  static History history_of(const std::vector<Trace>* traces, const std::string& channel) {
    if (traces == nullptr) return {};
    const auto time = std::ranges::find(*traces, "time", &Trace::name);
    const auto found = std::ranges::find(*traces, channel, &Trace::name);
    if (time == traces->end() || found == traces->end()) return {};
    return {time->values, found->values};
  }

  const std::vector<Trace>* histories_of(std::uint64_t id, const std::string& load_case) const {
    return evaluation(id).status == Cause::ok ? find_histories_(id, load_case) : nullptr;
  }

  void judge_histories(const LevelCourse& course, std::size_t load_case) {
    const std::string& name = cases_[load_case].load_case;
    for (const SeriesInput& series : input_.series) {
      const std::size_t first = result_.ladders.size();
      std::vector<SeriesLadder> found;
      for (const Channel& channel : evaluator_.signals().trace) {
        if (!is_in_group(channel.name, series.signal)) continue;
        QuantityLadder ladder = begin_ladder(course, name);
        ladder.quantity = name.empty() ? channel.name : name + "." + channel.name;
        ladder.unit = channel.unit;
        ladder.kind = QuantityKind::series;
        ladder.wanted = input_.wanted_error;
        std::vector<History> histories;
        for (const std::uint64_t id : course.ids) {
          histories.push_back(history_of(histories_of(id, name), channel.name));
        }
        auto one = make_series_ladder(course.h, histories, series.norm, series.window,
                                      reference_history(load_case, channel.name));
        if (!one) one.emplace().ladder = empty_ladder(course.h);
        found.push_back(std::move(*one));
        result_.ladders.push_back(std::move(ladder));
      }
      judge_series(course, first, found);
    }
  }

  static Ladder empty_ladder(const std::vector<double>& h) {
    const std::vector<double> none(h.size(), kUnknown);
    return {h, none, none, {}, 1.0, false};
  }

  std::optional<History> reference_history(std::size_t load_case,
                                           const std::string& channel) const {
    if (!evaluator_.has_reference(load_case)) return std::nullopt;
    const ReferenceRecord* record = evaluator_.known_reference(load_case);
    if (record == nullptr) return std::nullopt;
    const History history = history_of(&record->traces, channel);
    return history.time.empty() ? std::nullopt : std::optional(history);
  }

  // Rounding is that of the largest component.
  void judge_series(const LevelCourse& course, std::size_t first,
                    std::vector<SeriesLadder>& found) {
    double scale = 0.0;
    for (const SeriesLadder& one : found) scale = std::max(scale, one.ladder.scale);
    for (std::size_t i = 0; i < found.size(); ++i) {
      QuantityLadder& ladder = result_.ladders[first + i];
      SeriesLadder& own = found[i];
      const double size = own.ladder.scale;
      own.ladder.scale = scale;
      ladder.refinement = judge_refinement(own.ladder, options_of(course, {}));
      if (own.to_finest.empty()) continue;
      const Refinement& judged = ladder.refinement;
      const bool is_known = judged.is_settled();
      // Of the finest level what the extrapolation leaves, of the others their distance beside it.
      const double rest =
          judged.behaviour == Behaviour::floor ? 0.0 : judged.uncertainty / judged.safety_factor;
      std::vector<Level> errors;
      for (std::size_t k = 0; k < course.h.size(); ++k) {
        errors.push_back({course.h[k], is_known ? own.to_finest[k] + rest : kUnknown});
      }
      take_needed(ladder, course, errors, ladder.wanted * size);
    }
  }

  // Over the ladders at the finest of the other value.
  void find_needed_of_all(std::size_t axis) {
    const VaryInput& vary = input_.vary[axis];
    NeededValue all;
    all.path = vary.parameter.path;
    all.unit = vary.parameter.unit;
    all.own = own_[axis];
    const RefineLimit limit = input_.refine[axis].limit;
    const auto h_of = [&](double size) { return h_of_size(limit, size); };
    for (const QuantityLadder& ladder : result_.ladders) {
      if (ladder.over != all.path || !ladder.at_finest) continue;
      if (ladder.needed_by == NeededBy::nothing) {
        ++all.unknown;
        continue;
      }
      const bool decides = std::isnan(all.needed) || h_of(ladder.needed) < h_of(all.needed);
      if (!decides) continue;
      all.needed = ladder.needed;
      all.by = ladder.needed_by;
      all.quantity = ladder.quantity;
      all.wanted = ladder.wanted;
    }
    all.fineness = h_of(all.needed) / h_of(all.own);
    result_.needed.push_back(std::move(all));
  }

  const Evaluator& evaluator_;
  const StudyInput& input_;
  const std::map<std::uint64_t, Evaluation>& evaluations_;
  const FindHistories& find_histories_;
  std::vector<StoredCase> cases_;
  std::vector<double> own_;  // by refined value
  Integrator integrator_ = Integrator::rk4;
  std::vector<Quantity> quantities_;
  Convergence result_;
};

}  // namespace

bool Convergence::is_settled() const {
  return std::ranges::all_of(
      ladders, [](const QuantityLadder& ladder) { return ladder.refinement.is_settled(); });
}

Convergence judge_convergence(const Evaluator& evaluator,
                              const std::map<std::uint64_t, Evaluation>& evaluations,
                              const FindHistories& find_histories) {
  return Judging(evaluator, evaluations, find_histories).run();
}

}  // namespace linkstudy::convergence
