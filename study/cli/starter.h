// The inputs that `linkstudy init` writes. Their texts are the files of study/cli/starter, and
// jobs/slurm_study.sbatch for the batch script. In the files
//   FILE_NAME, MODEL_NAME, RESULTS_NAME   stand for names,
//   a line that ends in "#@ path"         gets what the key tables say of that key as a comment,
//   a line "#? path"                      becomes the default of that key, commented out.
#pragma once

#include <string>
#include <vector>

namespace linkstudy {

struct StarterTexts {
  std::string model;
  std::string study;
  std::string tune;
  std::string converge;
  std::string batch;
};

// As in the files.
const StarterTexts& starter_texts();

struct StarterNames {
  std::string file;     // of the input, without its folder
  std::string model;    // as a study or tune names it
  std::string results;  // directory
};

// "model", "study", "tune", "converge"
std::vector<std::string> starter_kinds();

// kind is one of starter_kinds().
std::string make_starter(const std::string& kind, const StarterNames& names);

// A batch script for `linkstudy VERB`, with `program` unless $LINKSTUDY names another.
std::string make_batch_script(const std::string& verb, const std::string& script,
                              const StarterNames& names, const std::string& program);

}  // namespace linkstudy
