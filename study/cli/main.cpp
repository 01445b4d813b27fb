#include "study/cli/run.h"
#include "study/specialize/fixed_kernels.h"

int main(int argc, char** argv) {
  linkstudy::add_fixed_kernels();
  return linkstudy::run_program({argv + 1, argv + argc});
}
