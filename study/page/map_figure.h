// Evaluations over two parameters, coloured by their largest error over its tolerance.
#pragma once

#include "study/page/paper_figure.h"

namespace linkstudy {

// Rows where every parameter but these has its most frequent value (of equals the first), words
// too, one parameter after the other; ascending.
std::vector<std::size_t> usual_rows(const std::vector<Evaluation>& rows, std::size_t a,
                                    std::size_t b);

// Of the first two parameters of numbers that vary, as the page draws it (web/map.js); a tune's
// step only where it has several. Nothing where fewer vary or nothing is judged.
std::optional<PaperFigure> map_figure(const StudyResults& results);

}  // namespace linkstudy
