#include "study/page/history_panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "study/metrics/response_list.h"
#include "study/report/results_tables.h"
#include "study/report/table_cells.h"

namespace linkstudy {
namespace {

using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

void add_once(Names& names, const std::string& name) {
  if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

bool is_number_text(std::string_view text) {
  return !text.empty() &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
}

// 0 what was matched, 1 forces of closures, 2 what else closures have, 3 the rest.
int weight_of(const std::string& group, const Names& matched) {
  if (std::ranges::find(matched, group) != matched.end()) return 0;
  if (!group.starts_with("closure.")) return 3;
  return group.ends_with(".force") || group.ends_with(".torque") ? 1 : 2;
}

class PanelChoice {
 public:
  PanelChoice(const StudyResults& results, const MovingRuns& again,
              const std::vector<const TraceSet*>& histories)
      : results_(results), again_(again) {
    for (const TraceSet* set : histories) {
      for (const Trace& trace : set->traces) {
        has_course_ = has_course_ || trace.values.size() > 1;
        if (trace.name == "time") continue;
        add_once(groups_, channel_group(trace.name));
        if (is_coordinate(trace.name)) add_once(overs_, trace.name);
      }
    }
    Names matched;
    for (const StoredCase& one : split_responses(results.description.responses)) {
      for (const StoredErrors& errors : one.matches) {
        for (const std::string& channel : errors.channels)
          matched.push_back(channel_group(channel));
      }
    }
    std::ranges::stable_sort(groups_, {},
                             [&](const std::string& group) { return weight_of(group, matched); });
  }

  Json make() {
    if (has_course_ && !groups_.empty()) choose();
    return {{"groups", groups_}, {"overs", overs_}, {"panels", panels_}, {"marks", marks()}};
  }

 private:
  void open(const std::string& group, const std::string& over) {
    const bool is_there = std::ranges::find(groups_, group) != groups_.end();
    if (is_there) panels_.push_back({{"group", group}, {"over", over}});
  }

  void choose() {
    const MovingRun* first = again_.runs.empty() ? nullptr : &again_.runs.front();
    if (first != nullptr && !first->driven.empty()) {
      choose_course(*first);
      return;
    }
    open(groups_.front(), "time");
    if (first != nullptr && overs_.size() > 1) open(groups_.front(), overs_[1]);
    if (first != nullptr) choose_clearance(*first);
  }

  // What the drive moves, how well, and whether the linkage stays what it is.
  void choose_course(const MovingRun& course) {
    const std::string& over = course.driven.front();
    const auto output = std::ranges::find_if(groups_, [&](const std::string& group) {
      return group.ends_with(".q") && group.starts_with("joint.") &&
             std::ranges::none_of(course.driven, [&](const std::string& driven) {
               return channel_group(driven) == group;
             });
    });
    if (output != groups_.end()) {
      const std::string owner = output->substr(0, output->size() - 1);
      for (const char* quantity : {"q", "v", "a"}) open(owner + quantity, over);
    }
    for (const char* group : {"quality", "mobility"}) open(group, over);
  }

  // Displacement, velocity and acceleration of what slides, and the forces of contact: what tells
  // a loose joint from an ideal one ([AugUrb18], figs. 8-10).
  void choose_clearance(const MovingRun& run) {
    const bool is_loose = std::ranges::any_of(run.linkage.closures, [](const Closure& closure) {
      return closure.model == ClosureModel::clearance;
    });
    if (!is_loose) return;
    for (const Closure& closure : run.linkage.closures) {
      if (closure.model == ClosureModel::clearance) {
        open("closure." + closure.name + ".normal_force", "time");
      }
    }
    const auto slider = std::ranges::find(run.linkage.joints, JointType::prismatic, &Joint::type);
    if (slider == run.linkage.joints.end()) return;
    for (const char* quantity : {"q", "v", "a"}) {
      open("joint." + slider->name + "." + quantity, "time");
    }
  }

  Json marks() const {
    Json all = Json::array();
    const Table* table = find_answer_table(results_, AnswerKind::kinematics, "singular");
    if (table == nullptr) return all;
    const Column& kind = *find_column(*table, "kind");
    for (std::size_t row = 0; row < row_count(*table); ++row) {
      Json at = Json::object();
      for (const Column& column : table->columns) {
        if (column.name == "time" || is_coordinate(column.name)) {
          at[column.name] = json_cell(column, row);
        }
      }
      all.push_back({{"name", json_cell(kind, row)}, {"at", at}});
    }
    return all;
  }

  const StudyResults& results_;
  const MovingRuns& again_;
  bool has_course_ = false;
  Names groups_;
  Names overs_ = {"time"};
  Json panels_ = Json::array();
};

}  // namespace

std::string channel_group(const std::string& channel) {
  const std::size_t dot = channel.rfind('.');
  if (dot == std::string::npos) return channel;
  const std::string_view last = std::string_view(channel).substr(dot + 1);
  const bool is_part = last == "x" || last == "y" || last == "z" || is_number_text(last);
  return is_part ? channel.substr(0, dot) : channel;
}

bool is_coordinate(const std::string& channel) {
  return channel.starts_with("joint.") && channel_group(channel).ends_with(".q");
}

Json history_panels(const StudyResults& results, const MovingRuns& again,
                    const std::vector<const TraceSet*>& histories) {
  return PanelChoice(results, again, histories).make();
}

}  // namespace linkstudy
