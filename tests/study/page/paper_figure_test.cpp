// What gnuplot is told of a figure.
#include "study/page/paper_figure.h"

#include <gmock/gmock.h>

#include <cmath>

namespace linkstudy::testing::paper_figure_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

PaperFigure errors_of_two() {
  PaperFigure figure;
  figure.x = {"stiffness [N/m]", true};
  figure.y = {"error", true};
  figure.series = {{"force.x", {1e5, 1e6, 1e7}, {0.2, std::nan(""), 0.002}, true, 0, 0},
                   {"it's \"$(quoted)\"", {1e5, -1.0}, {0.3, 0.1}, false, 1, 1}};
  figure.marks = {{"tolerance", 0.02, false}, {"answer", 8e5, true}};
  return figure;
}

TEST(GnuplotScript, Holds_the_numbers_and_leaves_gaps_where_there_are_none) {
  const std::string script = gnuplot_script(errors_of_two(), PaperFormat::svg, "a.svg");
  EXPECT_THAT(script, HasSubstr("$s0 << LINKSTUDY_END\n100000 0.2\n\n10000000 0.002\n"
                                "LINKSTUDY_END\n"));
  // What has no place on a logarithmic axis is a gap, too.
  EXPECT_THAT(script, HasSubstr("$s1 << LINKSTUDY_END\n100000 0.3\n\nLINKSTUDY_END\n"));
  EXPECT_THAT(script, HasSubstr("set logscale x"));
  EXPECT_THAT(script, HasSubstr("from first 800000, graph 0"));
  EXPECT_THAT(script, HasSubstr("from graph 0, first 0.02 "));
}

TEST(GnuplotScript, Texts_are_texts) {
  PaperFigure figure = errors_of_two();
  figure.series[1].title = "x'\nsystem 'touch /tmp/x'";
  const std::string script = gnuplot_script(figure, PaperFormat::pdf, "it's.pdf");
  EXPECT_THAT(script, HasSubstr("set output 'it''s.pdf'"));
  EXPECT_THAT(script, HasSubstr("title 'x'' system ''touch /tmp/x'''"));
  EXPECT_THAT(script, Not(HasSubstr("\nsystem")));
}

TEST(GnuplotScript, Series_differ_without_colour) {
  const std::string script = gnuplot_script(errors_of_two(), PaperFormat::png, "a.png");
  EXPECT_THAT(script, HasSubstr("linespoints pt 4 ps 0.4 lc rgb '#0072b2' dt 1"));
  EXPECT_THAT(script, HasSubstr("lines lc rgb '#d55e00' dt 2"));
}

TEST(GnuplotScript, Shades_are_a_third_number_on_a_scale_of_their_own) {
  PaperFigure figure;
  figure.colour = PaperAxis{"error / tolerance", true};
  figure.series = {{"within", {1.0, 2.0}, {3.0, 4.0}}, {"failed", {5.0}, {6.0}}};
  figure.series[0].point = 7;
  figure.series[0].shade = {0.25, 0.5};
  figure.series[1].point = 2;
  const std::string script = gnuplot_script(figure, PaperFormat::svg, "map.svg");
  EXPECT_THAT(script, HasSubstr("$s0 << LINKSTUDY_END\n1 3 0.25\n2 4 0.5\nLINKSTUDY_END\n"));
  EXPECT_THAT(script, HasSubstr("$s1 << LINKSTUDY_END\n5 6\nLINKSTUDY_END\n"));
  EXPECT_THAT(script, HasSubstr("$s0 using 1:2:3 with points pt 7"));
  EXPECT_THAT(script, HasSubstr("$s1 using 1:2 with points pt 2"));
  EXPECT_THAT(script, HasSubstr("set logscale cb"));
  EXPECT_THAT(gnuplot_script(errors_of_two(), PaperFormat::svg, "a.svg"),
              Not(HasSubstr("palette")));
}

}  // namespace
}  // namespace linkstudy::testing::paper_figure_test
