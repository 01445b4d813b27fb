// Writes the sample study, and one that has not begun, for open_results.py.
// usage: write_sample FULL.h5 EMPTY.h5
#include "study/store/results_file.h"
#include "tests/study/store/sample/sample.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  linkstudy::StudyResults begun;
  begun.description = linkstudy::sample::description();
  begun.input_sha256 = linkstudy::sample::kInputSha256;
  linkstudy::write_results(argv[1], linkstudy::sample::results());
  linkstudy::write_results(argv[2], begun);
}
