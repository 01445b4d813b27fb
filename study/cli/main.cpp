#include "study/cli/run.h"

int main(int argc, char** argv) {
  return linkstudy::run_program({argv + 1, argv + argc});
}
