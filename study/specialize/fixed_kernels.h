// Step loops made for single structures when the program was built: LINKSTUDY_FIXED_MODELS.
#pragma once

namespace linkstudy {

// Makes them known to the engine; once, before the first run.
void add_fixed_kernels();

}  // namespace linkstudy
