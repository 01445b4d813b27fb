// A table with its parts as an HDF5 file that xarray (h5netcdf, netcdf4) and h5py open as it is:
// the axis of a group is a dimension scale in it, every dataset is attached to it, texts are
// variable-length UTF-8, bytes carry flag_values and flag_meanings, and there is no other kind of
// data. Attributes of a dataset: units, long_name, role, path (its free name).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "study/record/table.h"

namespace linkstudy {

// The tree's root is the file's root. The file appears whole or not at all: it is written as
// PATH.tmp, closed, synced and renamed. It is made in memory: its size must fit there.
void write_group_file(const std::filesystem::path& path, const Table& root);

// The same tree back; the root has no name.
Table read_group_file(const std::filesystem::path& path);

// [A-Za-z][A-Za-z0-9_]* : other characters become underscores, a first digit gets "n" before it.
std::string dataset_name(std::string_view free_name);

}  // namespace linkstudy
