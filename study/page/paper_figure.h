// Figures for papers, by gnuplot, from the tables of results: one column wide, units at the axes,
// series told apart by dashes and markers as well.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "study/page/moving_run.h"
#include "study/record/table.h"

namespace linkstudy {

struct PaperSeries {
  std::string title;
  std::vector<double> x;
  std::vector<double> y;  // NaN: a gap
  bool has_points = true;
  std::size_t colour = 0;  // of the list of colours
  std::size_t dash = 0;    // of the list of dashes
  // Lone points of one shape instead of a line; those with numbers in `shade` have the colour of
  // those on the scale of the figure.
  std::optional<int> point{};
  std::vector<double> shade{};
};

struct PaperAxis {
  std::string label;  // with its unit
  bool is_logarithmic = false;
};

struct PaperMark {  // a line across the figure
  std::string title;
  double value = 0.0;
  bool is_vertical = false;
};

struct PaperFigure {
  PaperAxis x, y;
  std::optional<PaperAxis> colour{};  // scale of the shades
  std::vector<PaperSeries> series{};
  std::vector<PaperMark> marks{};
};

// "step [s]"; pure numbers have none.
std::string with_unit(const std::string& label, const std::string& unit);

struct PaperKind {
  std::string_view name;
  std::string_view holds;
  // Nothing where these results have none.
  std::optional<PaperFigure> (*make)(const StudyResults& results);
};
// A further one is a further row.
std::span<const PaperKind> paper_kinds();

// Throws UsageError with the names that these results have.
PaperFigure make_paper_figure(const StudyResults& results, std::string_view name);

enum class PaperFormat { svg, pdf, png };

template <>
inline constexpr auto kWords<PaperFormat> = make_words<PaperFormat>({{PaperFormat::svg, "svg"},
                                                                     {PaperFormat::pdf, "pdf"},
                                                                     {PaperFormat::png, "png"}});

// What gnuplot is told; data stand in it.
std::string gnuplot_script(const PaperFigure& figure, PaperFormat format,
                           const std::filesystem::path& output);

// Writes the file whole or not at all. Throws UsageError where there is no gnuplot, StoreError with
// what it says where it fails.
void draw_paper_figure(const PaperFigure& figure, PaperFormat format,
                       const std::filesystem::path& output);

}  // namespace linkstudy
