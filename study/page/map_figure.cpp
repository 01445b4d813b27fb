#include "study/page/map_figure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "study/config/file_kind.h"
#include "study/page/judged_ratios.h"
#include "study/page/rows_along.h"
#include "study/record/digest.h"
#include "study/report/results_tables.h"

namespace linkstudy {
namespace {

bool has_several_steps(const StudyResults& results) {
  const Table* tuning = find_answer_table(results, AnswerKind::tuning, "result");
  return tuning != nullptr && find_column(*tuning, "target_step") != nullptr;
}

struct Marks {
  const char* title;
  int point;  // of gnuplot
  bool (*holds)(double ratio);
};

constexpr std::array<Marks, 3> kMarks = {
    {{"within tolerance", 7, [](double ratio) { return ratio <= 1.0; }},
     {"beyond tolerance", 9, [](double ratio) { return ratio > 1.0; }},
     {"failed", 2, [](double ratio) { return std::isnan(ratio); }}}};

}  // namespace

std::vector<std::size_t> map_parameters(const StudyResults& results,
                                        const std::vector<Evaluation>& rows) {
  const bool only_confirms = find_word<FileKind>(results.description.kind) == FileKind::tune &&
                             !has_several_steps(results);
  std::vector<std::size_t> found;
  for (std::size_t p = 0; p < results.description.parameters.size(); ++p) {
    if (only_confirms && results.description.parameters[p].path == "simulation.step") continue;
    const std::optional<std::vector<double>> own = parameter_numbers(rows, p);
    if (own && std::ranges::count(*own, own->front()) < std::ssize(*own)) found.push_back(p);
  }
  return found;
}

// Their middle tells.
bool is_by_ratios(const std::vector<Evaluation>& rows, const std::vector<std::size_t>& chosen,
                  std::size_t parameter) {
  std::vector<double> values;
  for (const std::size_t row : chosen) {
    values.push_back(std::get<double>(rows[row].point.values.at(parameter)));
  }
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  const std::size_t n = values.size();
  if (n == 0) return false;
  const double low = values.front();
  const double high = values.back();
  const double middle = (values[(n - 1) / 2] + values[n / 2]) / 2.0;
  return low > 0.0 && high > 3.0 * low &&
         std::abs(middle - std::sqrt(low * high)) < std::abs(middle - (low + high) / 2.0);
}

std::optional<PaperFigure> map_figure(const StudyResults& results) {
  const std::vector<Evaluation> rows = latest_by_id(results.evaluations);
  if (rows.empty()) return std::nullopt;
  const std::vector<std::size_t> two = map_parameters(results, rows);
  if (two.size() < 2) return std::nullopt;
  const std::vector<double> ratios = judged_ratios(results, rows);
  if (ratios.empty()) return std::nullopt;
  const std::vector<std::size_t> chosen = usual_rows(rows, {two[0], two[1]});
  PaperFigure figure;
  const auto place = [&](std::size_t axis, std::size_t row) {
    return std::get<double>(rows[row].point.values[two[axis]]);
  };
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const Parameter& parameter = results.description.parameters[two[axis]];
    PaperAxis& drawn = axis == 0 ? figure.x : figure.y;
    drawn =
        PaperAxis{with_unit(parameter.path, parameter.unit), is_by_ratios(rows, chosen, two[axis])};
  }
  figure.colour = PaperAxis{"largest error / tolerance", true};
  for (const Marks& mark : kMarks) {
    PaperSeries series{mark.title, {}, {}};
    series.point = mark.point;
    for (const std::size_t row : chosen) {
      if (!mark.holds(ratios[row])) continue;
      series.x.push_back(place(0, row));
      series.y.push_back(place(1, row));
      if (!std::isnan(ratios[row])) series.shade.push_back(ratios[row]);
    }
    if (!series.x.empty()) figure.series.push_back(std::move(series));
  }
  return figure;
}

}  // namespace linkstudy
