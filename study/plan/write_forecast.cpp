#include "study/plan/write_forecast.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "study/record/counted.h"
#include "study/record/findings.h"
#include "study/report/write_table.h"
#include "study/schedule/progress.h"
#include "study/store/results_tree.h"

namespace linkstudy::plan {
namespace {

using Json = nlohmann::ordered_json;

std::string bytes_text(double bytes) {
  if (bytes < 1e6) return fmt::format("{:.3g} kB", bytes / 1e3);
  return bytes < 1e9 ? fmt::format("{:.3g} MB", bytes / 1e6)
                     : fmt::format("{:.3g} GB", bytes / 1e9);
}

bool is_design(const PlannedWork& work) {
  return work.most == work.points.size();
}

std::string evaluations_text(const Forecast& forecast) {
  const PlannedWork& work = forecast.work;
  std::string text = is_design(work) ? fmt::format("{}", work.most)
                                     : fmt::format("{} of {}, at most {} in all",
                                                   work.points.size(), work.certain_are, work.most);
  if (forecast.load_cases > 1) text += fmt::format(", in {} load cases", forecast.load_cases);
  if (forecast.invalid > 0) text += fmt::format("; {} are no valid model", forecast.invalid);
  return text;
}

std::string runs_text(const Forecast& forecast) {
  const PlannedWork& work = forecast.work;
  std::string text = fmt::format("{}{}", is_design(work) ? "" : "at most ",
                                 counted(work.most * forecast.load_cases, "run"));
  if (forecast.references > 0) text += " and " + counted(forecast.references, "reference run");
  if (forecast.most_steps > 0) {
    text += forecast.least_steps == forecast.most_steps
                ? fmt::format("; {} steps each", forecast.most_steps)
                : fmt::format("; {} to {} steps", forecast.least_steps, forecast.most_steps);
  }
  if (forecast.has_adaptive) text += "; steps chosen by tolerances";
  return text;
}

std::string measured_text(const Measured& measured) {
  std::string text = fmt::format("over {:.3g} steps in {:.1f} s", measured.steps, measured.spent_s);
  if (measured.kinds > 1) {
    text += fmt::format(", {} of {} kinds of runs", measured.probed, measured.kinds);
  }
  return text + "; runs that fail early cost less";
}

std::string cost_text(const Forecast& forecast) {
  const bool is_bounded = !is_design(forecast.work);
  std::string text =
      fmt::format("{}{} of CPU", is_bounded ? "at most " : "", duration_text(forecast.most.cpu_s));
  if (is_bounded) {
    text +=
        fmt::format(", {} for {}", duration_text(forecast.asked.cpu_s), forecast.work.certain_are);
  }
  if (forecast.references > 0) {
    text += fmt::format("; {} of it for {}", duration_text(forecast.references_s),
                        forecast.references == 1 ? "the reference" : "the references");
  }
  return text;
}

std::string wall_text(const Forecast& forecast) {
  const int ranks = forecast.asked.ranks;
  std::string text = fmt::format("{}{} on {}", is_design(forecast.work) ? "" : "at most ",
                                 duration_text(forecast.most.wall_s),
                                 counted(static_cast<std::uint64_t>(ranks), "rank"));
  const Measured& measured = forecast.measured;
  if (measured.at_once > 1) {
    text += fmt::format(", where runs take {:.1f} times as long as alone", measured.slowdown);
  }
  return text + fmt::format("; more than {} are of no use", forecast.useful_ranks);
}

Table layouts_table(const std::vector<Layout>& layouts) {
  TableOf<Layout> table("layouts", "layout", layouts);
  table.add("ranks", "", "MPI ranks", [](const Layout& one) { return std::int64_t{one.ranks}; });
  table.add("packs", "", "tasks that ranks pull",
            [](const Layout& one) { return static_cast<std::int64_t>(one.packs); });
  table.add("widest", "", "evaluations side by side in the widest",
            [](const Layout& one) { return static_cast<std::int64_t>(one.widest); });
  table.add(
      "cpu", "s", "CPU time of all ranks", [](const Layout& one) { return one.cpu_s; }, "{:.3g}");
  table.add(
      "wall", "s", "until the last pack has ended", [](const Layout& one) { return one.wall_s; },
      "{:.3g}");
  table.add(
      "busy", "%", "part of the ranks' time that is work",
      [](const Layout& one) { return 100.0 * one.busy; }, "{:.0f}");
  return table.take();
}

Json to_json(const Layout& layout) {
  return {{"ranks", layout.ranks}, {"packs", layout.packs},   {"widest", layout.widest},
          {"cpu_s", layout.cpu_s}, {"wall_s", layout.wall_s}, {"busy", layout.busy}};
}

}  // namespace

std::string write_text(const StudyInput& input, const Forecast& forecast) {
  std::string text = fmt::format("{}: {}\n", name_of(input.kind), input.name);
  text += summary_line("evaluations", evaluations_text(forecast));
  text += summary_line("runs", runs_text(forecast));
  if (forecast.measured.kinds > 0) {
    text += summary_line("cost", cost_text(forecast));
    text += summary_line("measured", measured_text(forecast.measured));
    text += summary_line("wall time", wall_text(forecast));
  }
  const Sizes& sizes = forecast.sizes;
  text += summary_line("memory", fmt::format("{} a rank, {} on the first", bytes_text(sizes.rank),
                                             bytes_text(sizes.first_rank)));
  text += summary_line("disk", fmt::format("{}journal.bin {}, results.h5 {}",
                                           is_design(forecast.work) ? "" : "at most ",
                                           bytes_text(sizes.journal), bytes_text(sizes.results)));
  if (forecast.layouts.empty()) return text;
  return text + "\n" + text_of(layouts_table(forecast.layouts), output_width());
}

std::string write_json(const StudyInput& input, const Forecast& forecast) {
  const Measured& measured = forecast.measured;
  Json json = {
      {"kind", name_of(input.kind)},
      {"name", input.name},
      {"evaluations", forecast.work.points.size()},
      {"most_evaluations", forecast.work.most},
      {"invalid", forecast.invalid},
      {"load_cases", forecast.load_cases},
      {"runs", forecast.work.points.size() * forecast.load_cases},
      {"reference_runs", forecast.references},
      {"steps",
       {{"least", forecast.least_steps},
        {"most", forecast.most_steps},
        {"all", forecast.steps},
        {"adaptive", forecast.has_adaptive}}},
      {"lanes", forecast.lanes},
      {"measured", nullptr},
      {"memory_bytes", {{"rank", forecast.sizes.rank}, {"first_rank", forecast.sizes.first_rank}}},
      {"disk_bytes", {{"journal", forecast.sizes.journal}, {"results", forecast.sizes.results}}}};
  if (measured.kinds == 0) return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  json["measured"] = {{"cpu_s", measured.spent_s},   {"steps", measured.steps},
                      {"kinds", measured.kinds},     {"probed", measured.probed},
                      {"at_once", measured.at_once}, {"slowdown", measured.slowdown}};
  json["references_cpu_s"] = forecast.references_s;
  json["certain"] = to_json(forecast.asked);
  json["most"] = to_json(forecast.most);
  json["useful_ranks"] = forecast.useful_ranks;
  json["layouts"] = Json::array();
  for (const Layout& one : forecast.layouts) json["layouts"].push_back(to_json(one));
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Table evaluations_table(const Evaluator& study, const PlannedWork& work) {
  std::vector<Evaluation> evaluations;
  for (const Point& point : work.points) evaluations.emplace_back().point = point;
  StudyDescription description;
  description.parameters = study.parameters();
  Table table = study_group(description, evaluations);
  table.columns.resize(1 + description.parameters.size());  // nothing has come out yet
  return table;
}

}  // namespace linkstudy::plan
