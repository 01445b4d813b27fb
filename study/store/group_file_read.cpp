#include <fmt/format.h>

#include <sstream>

#include "study/store/group_file.h"
#include "study/store/hdf5_handle.h"
#include "study/store/store_error.h"

namespace linkstudy {
namespace {

using hdf5::check;

// A C string that the library allocated for us, or null for an empty one.
std::string take_text(char* text) {
  const std::string copy = text == nullptr ? "" : text;
  H5free_memory(text);
  return copy;
}

std::string read_text_attribute(hid_t attribute) {
  const hdf5::TypeHandle type = hdf5::string_type();
  char* text = nullptr;
  check(H5Aread(attribute, type, &text), "read a text");
  return take_text(text);
}

// Text of an attribute, empty where there is none.
std::string text_of(hid_t object, const char* name) {
  if (check(H5Aexists(object, name), name) == 0) {
    return {};
  }
  return read_text_attribute(hdf5::AttributeHandle(H5Aopen(object, name, H5P_DEFAULT), name));
}

template <class Number>
Number read_number_attribute(hid_t attribute, hid_t type) {
  Number value{};
  check(H5Aread(attribute, type, &value), "read a number");
  return value;
}

Attribute read_attribute(hid_t attribute, const std::string& name) {
  const hdf5::TypeHandle type(H5Aget_type(attribute), name);
  if (H5Tget_class(type) == H5T_STRING) {
    return {name, read_text_attribute(attribute)};
  }
  if (H5Tget_class(type) == H5T_FLOAT) {
    return {name, read_number_attribute<double>(attribute, H5T_NATIVE_DOUBLE)};
  }
  if (H5Tget_sign(type) == H5T_SGN_NONE) {
    return {name, read_number_attribute<std::uint64_t>(attribute, H5T_NATIVE_UINT64)};
  }
  return {name, read_number_attribute<std::int64_t>(attribute, H5T_NATIVE_INT64)};
}

herr_t keep_name(hid_t, const char* name, const H5A_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

std::vector<Attribute> read_attributes(hid_t object) {
  std::vector<std::string> names;
  check(H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, keep_name, &names),
        "list attributes");
  std::vector<Attribute> attributes;
  for (const std::string& name : names) {
    if (name != "path") {
      const hdf5::AttributeHandle handle(H5Aopen(object, name.c_str(), H5P_DEFAULT), name);
      attributes.push_back(read_attribute(handle, name));
    }
  }
  return attributes;
}

template <class Number>
std::vector<Number> read_numbers(hid_t dataset, std::size_t count, hid_t type) {
  std::vector<Number> values(count);
  check(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "read a dataset");
  return values;
}

std::vector<std::string> read_texts(hid_t dataset, std::size_t count) {
  const hdf5::TypeHandle type = hdf5::string_type();
  std::vector<char*> data(count, nullptr);
  check(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()), "read a dataset");
  std::vector<std::string> texts;
  for (char* text : data) texts.push_back(take_text(text));
  return texts;
}

ColumnValues read_values(hid_t dataset) {
  const hdf5::SpaceHandle space(H5Dget_space(dataset), "read a shape");
  const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
  const hdf5::TypeHandle type(H5Dget_type(dataset), "read a type");
  switch (H5Tget_class(type)) {
    case H5T_STRING:
      return read_texts(dataset, count);
    case H5T_FLOAT:
      return read_numbers<double>(dataset, count, H5T_NATIVE_DOUBLE);
    case H5T_INTEGER:
      if (H5Tget_size(type) == 1) {
        return read_numbers<std::uint8_t>(dataset, count, H5T_NATIVE_UINT8);
      }
      return read_numbers<std::int64_t>(dataset, count, H5T_NATIVE_INT64);
    default:
      throw StoreError("a dataset is neither numbers nor texts");
  }
}

Column read_column(hid_t dataset) {
  Column column;
  column.name = text_of(dataset, "path");
  column.unit = text_of(dataset, "units");
  column.meaning = text_of(dataset, "long_name");
  column.role = text_of(dataset, "role");
  if (const std::string format = text_of(dataset, "format"); !format.empty()) {
    column.format = format;
  }
  if (column.unit == "1") column.unit = text_of(dataset, "unit");
  std::istringstream meanings(text_of(dataset, "flag_meanings"));
  for (std::string word; meanings >> word;) column.words.push_back(word);
  column.values = read_values(dataset);
  return column;
}

bool is_chunked(hid_t dataset) {
  const hdf5::PropertyHandle properties(H5Dget_create_plist(dataset), "read the storage");
  return H5Pget_layout(properties) == H5D_CHUNKED;
}

std::string link_name(hid_t group, hsize_t index) {
  const auto get = [&](char* text, std::size_t size) {
    return check(static_cast<hid_t>(H5Lget_name_by_idx(group, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC,
                                                       index, text, size, H5P_DEFAULT)),
                 "list a group");
  };
  std::string name(static_cast<std::size_t>(get(nullptr, 0)), '\0');
  get(name.data(), name.size() + 1);
  return name;
}

std::vector<std::string> link_names(hid_t group) {
  H5G_info_t info = {};
  check(H5Gget_info(group, &info), "list a group");
  std::vector<std::string> names;
  for (hsize_t i = 0; i < info.nlinks; ++i) names.push_back(link_name(group, i));
  return names;
}

Table read_group(hid_t group) {
  Table data;
  data.attributes = read_attributes(group);
  for (const std::string& name : link_names(group)) {
    const hdf5::ObjectHandle object(H5Oopen(group, name.c_str(), H5P_DEFAULT), "open " + name);
    if (H5Iget_type(object) == H5I_GROUP) {
      data.parts.push_back(read_group(object));
      data.parts.back().name = text_of(object, "path");
      continue;
    }
    Column column = read_column(object);
    if (column.role != "row") {
      data.compressed = data.compressed || is_chunked(object);
      data.columns.push_back(std::move(column));
    }
  }
  return data;
}

}  // namespace

Table read_group_file(const std::filesystem::path& path) {
  const hdf5::Quiet quiet;
  try {
    const hdf5::FileHandle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, hdf5::file_access()),
                                "open the file");
    return read_group(file);
  } catch (const StoreError& error) {
    throw StoreError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace linkstudy
