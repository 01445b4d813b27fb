// What a [[vary]] says of its parameter, in one of the forms that the design takes:
//   grid, list                       values, lin, log, ladder, around
//   centered                         around
//   vector                           lin, log: first and last
//   latin_hypercube, sobol, saltelli lin, log: lowest and highest; normal, triangular
//   morris                           lin, log: lowest and highest
#pragma once

#include "study/config/named_parameter.h"
#include "study/design/axis.h"
#include "study/design/design_options.h"

namespace linkstudy {

struct ReadAxis {
  // With the places they were written at; of a sampled design the ends of what samples can be.
  std::vector<Tree> values;
  std::size_t center = 0;  // of around, by position
  std::optional<Distribution> distribution = {};
};

// `vary` is a validated [[vary]] or [[refine]]. A centre that is not given is the value in
// `document`, and is written into `vary`. Nothing when it was reported.
std::optional<ReadAxis> read_axis(Tree& vary, const NamedParameter& of, const DesignOptions& design,
                                  const ModelDocument& document, Diagnostics& diagnostics);

}  // namespace linkstudy
