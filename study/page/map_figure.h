// Evaluations over two parameters, coloured by their largest error over its tolerance.
#pragma once

#include "study/page/paper_figure.h"

namespace linkstudy {

// Parameters of numbers that vary, by index: what a map can have as axes. A tune's step only where
// it has several.
std::vector<std::size_t> map_parameters(const StudyResults& results,
                                        const std::vector<Evaluation>& rows);

// True where the values of a parameter in these rows are spaced by ratios rather than differences.
bool is_by_ratios(const std::vector<Evaluation>& rows, const std::vector<std::size_t>& chosen,
                  std::size_t parameter);

// Of the first two parameters of numbers of map_parameters, as the page draws it (web/map.js).
// Nothing where there are fewer or nothing is judged.
std::optional<PaperFigure> map_figure(const StudyResults& results);

}  // namespace linkstudy
