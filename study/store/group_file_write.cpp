#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <stdexcept>

#include "study/store/file.h"
#include "study/store/group_file.h"
#include "study/store/hdf5_handle.h"
#include "study/store/hdf5_image.h"
#include "study/store/store_error.h"
#include "study/store/utf8.h"

namespace linkstudy {
namespace {

using hdf5::check;

constexpr hsize_t kChunk = 16384;  // values; 128 KiB of doubles
constexpr unsigned kDeflateLevel = 4;

// Type in the file and in memory of each kind of column.
hid_t file_type(double) {
  return H5T_IEEE_F64LE;
}
hid_t file_type(std::int64_t) {
  return H5T_STD_I64LE;
}
hid_t file_type(std::uint64_t) {
  return H5T_STD_U64LE;
}
hid_t file_type(std::uint8_t) {
  return H5T_STD_U8LE;
}
hid_t memory_type(double) {
  return H5T_NATIVE_DOUBLE;
}
hid_t memory_type(std::int64_t) {
  return H5T_NATIVE_INT64;
}
hid_t memory_type(std::uint64_t) {
  return H5T_NATIVE_UINT64;
}
hid_t memory_type(std::uint8_t) {
  return H5T_NATIVE_UINT8;
}

// Names within one group: two free names may become the same dataset name.
class Names {
 public:
  std::string take(std::string_view free_name) {
    const std::string base = dataset_name(free_name);
    std::string name = base;
    for (int i = 2; !taken_.insert(name).second; ++i) {
      name = fmt::format("{}_{}", base, i);
    }
    return name;
  }

 private:
  std::set<std::string> taken_;
};

void write_attribute(hid_t object, const char* name, std::string_view text) {
  const std::string valid = valid_utf8(text);
  const char* data = valid.c_str();
  const hdf5::TypeHandle type = hdf5::string_type();
  const hdf5::SpaceHandle space(H5Screate(H5S_SCALAR), name);
  const hdf5::AttributeHandle attribute(
      H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), name);
  check(H5Awrite(attribute, type, &data), name);
}

template <class Number>
void write_number_attribute(hid_t object, const char* name, Number value) {
  const hdf5::SpaceHandle space(H5Screate(H5S_SCALAR), name);
  const hdf5::AttributeHandle attribute(
      H5Acreate2(object, name, file_type(value), space, H5P_DEFAULT, H5P_DEFAULT), name);
  check(H5Awrite(attribute, memory_type(value), &value), name);
}

void write_attribute(hid_t object, const Attribute& attribute) {
  const std::string name = dataset_name(attribute.name);
  std::visit(
      [&](const auto& value) {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>) {
          write_attribute(object, name.c_str(), value);
        } else {
          write_number_attribute(object, name.c_str(), value);
        }
      },
      attribute.value);
}

void write_flags(hid_t dataset, const std::vector<std::string>& meanings) {
  std::vector<std::uint8_t> values(meanings.size());
  std::iota(values.begin(), values.end(), std::uint8_t{0});
  const hsize_t count = values.size();
  const hdf5::SpaceHandle space(H5Screate_simple(1, &count, nullptr), "flag_values");
  const hdf5::AttributeHandle attribute(
      H5Acreate2(dataset, "flag_values", H5T_STD_U8LE, space, H5P_DEFAULT, H5P_DEFAULT),
      "flag_values");
  check(H5Awrite(attribute, H5T_NATIVE_UINT8, values.data()), "flag_values");
  write_attribute(dataset, "flag_meanings", fmt::format("{}", fmt::join(meanings, " ")));
}

void write_description(hid_t dataset, const Column& column) {
  if (!column.unit.empty()) {
    write_attribute(dataset, "units", column.unit);
    if (column.unit == "1") write_attribute(dataset, "unit", column.unit);  // and not left out
  } else if (is_number(column)) {
    write_attribute(dataset, "units", "1");
  }
  write_attribute(dataset, "long_name", column.meaning.empty() ? column.name : column.meaning);
  write_attribute(dataset, "role", column.role.empty() ? "data" : column.role);
  write_attribute(dataset, "path", column.name);
  if (column.format != Column{}.format) write_attribute(dataset, "format", column.format);
  if (!column.words.empty()) write_flags(dataset, column.words);
}

hdf5::PropertyHandle storage(hsize_t count, bool compressed) {
  hdf5::PropertyHandle properties(H5Pcreate(H5P_DATASET_CREATE), "set storage");
  if (compressed && count > 0) {
    const hsize_t chunk = std::min(count, kChunk);
    check(H5Pset_chunk(properties, 1, &chunk), "set chunks");
    check(H5Pset_shuffle(properties), "set shuffling");
    check(H5Pset_deflate(properties, kDeflateLevel), "set compression");
  }
  return properties;
}

hdf5::DatasetHandle create_dataset(hid_t group, const std::string& name, hid_t type, hsize_t count,
                                   bool compressed) {
  const hdf5::SpaceHandle space(H5Screate_simple(1, &count, nullptr), name);
  return {H5Dcreate2(group, name.c_str(), type, space, H5P_DEFAULT, storage(count, compressed),
                     H5P_DEFAULT),
          "create dataset " + name};
}

hdf5::DatasetHandle write_values(hid_t group, const std::string& name,
                                 const std::vector<std::string>& texts, bool) {
  const hdf5::TypeHandle type = hdf5::string_type();
  hdf5::DatasetHandle dataset = create_dataset(group, name, type, texts.size(), false);
  std::vector<std::string> valid(texts.size());
  std::ranges::transform(texts, valid.begin(), valid_utf8);
  std::vector<const char*> data(texts.size());
  std::ranges::transform(valid, data.begin(), &std::string::c_str);
  check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()),
        "write dataset " + name);
  return dataset;
}

template <class Number>
hdf5::DatasetHandle write_values(hid_t group, const std::string& name,
                                 const std::vector<Number>& values, bool compressed) {
  hdf5::DatasetHandle dataset =
      create_dataset(group, name, file_type(Number{}), values.size(), compressed);
  check(H5Dwrite(dataset, memory_type(Number{}), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
        "write dataset " + name);
  return dataset;
}

hdf5::DatasetHandle write_column(hid_t group, Names& names, const Column& column, bool compressed) {
  const std::string name = names.take(column.name);
  hdf5::DatasetHandle dataset =
      std::visit([&](const auto& values) { return write_values(group, name, values, compressed); },
                 column.values);
  write_description(dataset, column);
  return dataset;
}

// The rows' numbers, for a group whose columns have no axis of their own.
Column row_numbers(std::size_t count) {
  std::vector<std::int64_t> rows(count);
  std::iota(rows.begin(), rows.end(), 0);
  return {"row", "", "row number", "row", rows};
}

void write_columns(hid_t group, Names& names, const Table& data) {
  if (data.columns.empty()) return;
  const std::size_t rows = row_count(data);
  const bool has_axis = data.columns.front().role == "axis";
  const Column axis = has_axis ? data.columns.front() : row_numbers(rows);
  const hdf5::DatasetHandle scale = write_column(group, names, axis, data.compressed);
  check(H5DSset_scale(scale, dataset_name(axis.name).c_str()), "make an axis of " + axis.name);
  for (std::size_t i = has_axis ? 1 : 0; i < data.columns.size(); ++i) {
    const hdf5::DatasetHandle dataset =
        write_column(group, names, data.columns[i], data.compressed);
    check(H5DSattach_scale(dataset, scale, 0), "attach the axis to " + data.columns[i].name);
  }
}

hdf5::PropertyHandle ordered(hid_t property_class) {
  hdf5::PropertyHandle properties(H5Pcreate(property_class), "set the order of links");
  check(H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED),
        "set the order of links");
  return properties;
}

void write_group(hid_t group, const Table& data) {
  Names names;
  for (const Attribute& attribute : data.attributes) write_attribute(group, attribute);
  write_columns(group, names, data);
  for (const Table& child : data.parts) {
    const std::string name = names.take(child.name);
    const hdf5::GroupHandle handle(
        H5Gcreate2(group, name.c_str(), H5P_DEFAULT, ordered(H5P_GROUP_CREATE), H5P_DEFAULT),
        "create group " + name);
    write_attribute(handle, "path", child.name);
    write_group(handle, child);
  }
}

}  // namespace

std::string dataset_name(std::string_view free_name) {
  std::string name(free_name);
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::ranges::replace_if(
      name, [&](char c) { return !is_letter(c) && !is_digit(c); }, '_');
  return !name.empty() && is_letter(name.front()) ? name : "n" + name;
}

void write_group_file(const std::filesystem::path& path, const Table& root) {
  const hdf5::Quiet quiet;
  std::string image;
  try {
    image =
        hdf5::make_image(ordered(H5P_FILE_CREATE), [&](hid_t file) { write_group(file, root); });
  } catch (const StoreError& error) {
    throw StoreError(fmt::format("{}: {}", path.string(), error.what()));
  }
  write_file_atomically(path, image);
}

}  // namespace linkstudy
