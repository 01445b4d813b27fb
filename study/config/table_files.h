// Tables of a model that stand in CSV files: a table with `file` and `columns` in place of two of
// its arrays. The numbers are taken when the model is read, and from then on the model holds them:
// what is kept of it needs no file.
#pragma once

#include <initializer_list>

#include "study/config/fields.h"

namespace linkstudy {

// "time" for the array "times".
struct FileColumn {
  std::string name, array;
};

// Replaces `file` and `columns` by the arrays, every number with its place in its file. `path`: of
// the model, which files are relative to. False when something was reported.
bool read_table_files(Tree& document, const KeyNode& schema, const std::string& path,
                      Diagnostics& diagnostics);

// What is left of `file` and `columns` was set, or has no fellow.
void refuse_left_file(Tree& value, const Reading& reading);
void refuse_left_columns(Tree& value, const Reading& reading);

// The rows of `file` and `columns`; two of the columns are given.
template <class Record>
void add_table_file(Fields<Record>& table, const Condition& only,
                    std::initializer_list<FileColumn> columns) {
  Fields<Record> heads;
  std::string arrays;
  for (const FileColumn& one : columns) {
    arrays += (arrays.empty() ? "" : ", ") + one.array;
    heads.read(one.name, {.type = KeyType::text,
                          .meaning = "head of the column of " + one.array +
                                     "; a unit stands in brackets at its end",
                          .held = one.array});
  }
  table.read(
      "file",
      {.type = KeyType::text,
       .meaning = "CSV file, relative to this file, that holds the table, in place of " + arrays +
                  "; read with the model, not set by a study",
       .only = only},
      [](Record&, Tree& value, const Reading& reading) { refuse_left_file(value, reading); });
  table.table(
      "columns", {.meaning = "heads of the two columns of file", .only = only}, std::move(heads),
      [](Record&, Tree& value, const Reading& reading) { refuse_left_columns(value, reading); });
}

}  // namespace linkstudy
