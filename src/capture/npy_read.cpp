#include "capture/npy_read.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/checked_product.h"
#include "capture/python_literal.h"
#include "rainref/error.h"

namespace rainref::capture {
namespace {

using Literal = PythonLiteral;

constexpr std::string_view signature = "\x93NUMPY";
// numpy.load itself rejects headers over 10 000 characters by default.
constexpr std::size_t longest_header = 65536;
constexpr std::string_view accepted = "'|u1', '<f2', '<f4' or '<u4'";

struct Refusal {
  std::string_view file;
  [[noreturn]] void operator()(const std::string& why) const { throw Error(ExitCode::port_files, fmt::format("{}: {}", file, why)); }
};

std::size_t type_bytes(std::string_view type) { return static_cast<std::size_t>(type.back() - '0'); }

// Makes an arbitrary text printable and short for a message.
std::string shown(std::string_view text) {
  std::string out(text.substr(0, 40));
  std::ranges::replace_if(
      out, [](char c) { return c < 0x20 || c > 0x7e; }, '?');
  return text.size() > 40 ? out + "..." : out;
}

// The canonical name of a number type; `where` names its owner.
std::string number_type(const Literal& descr, const std::string& where, const Refusal& refuse) {
  if (descr.kind != Literal::string) refuse(fmt::format("{}: expected {}", where, accepted));
  const std::string& text = descr.text;
  if (text.starts_with('>') && text != ">u1") {
    refuse(fmt::format("{}: '{}' is big endian; expected {} (a.astype(a.dtype.newbyteorder('<')))", where, shown(text), accepted));
  }
  if (text == "|u1" || text == "<u1" || text == ">u1") return "|u1";  // one byte has no order
  if (text == "<f2" || text == "<f4" || text == "<u4") return text;
  refuse(fmt::format("{}: expected {}, found '{}'", where, accepted, shown(text)));
}

// numpy pads packed structures with nameless fields of type '|V<bytes>'.
std::optional<std::size_t> padding_bytes(const Literal& name, const Literal& type) {
  if (!name.text.empty() || type.kind != Literal::string || !type.text.starts_with("|V")) return std::nullopt;
  const auto number = parse_python_literal(std::string_view(type.text).substr(2));
  if (!number || number->kind != Literal::integer) return std::nullopt;
  return number->number;
}

std::size_t components_of(const Literal& shape, const std::string& where, const Refusal& refuse) {
  const Literal& count = shape.kind == Literal::tuple && shape.items.size() == 1 ? shape.items[0] : shape;
  if (count.kind != Literal::integer || count.number < 1 || count.number > 4) {
    refuse(fmt::format("{}: expected a number or a row of 2 to 4, as ('<f4', (3,))", where));
  }
  return count.number;
}

std::string name_of(const Literal& literal, const Refusal& refuse) {
  if (literal.kind != Literal::string) refuse("descr: expected a text as the name of a field");
  return literal.text;
}

// [('x', '<f4'), ('', '|V4'), ('normal', '<f4', (3,)), ...]
void read_field_list(const Literal& descr, NpyHeader& out, const Refusal& refuse) {
  for (const Literal& item : descr.items) {
    if (item.kind != Literal::tuple || item.items.size() < 2 || item.items.size() > 3) {
      refuse("descr: expected fields as (name, type) or (name, type, shape)");
    }
    NpyField field{name_of(item.items[0], refuse), {}, out.record_bytes, 1};
    std::size_t bytes;
    if (const auto padding = padding_bytes(item.items[0], item.items[1])) {
      bytes = *padding;
    } else {
      const std::string where = fmt::format("field '{}'", shown(field.name));
      field.type = number_type(item.items[1], where, refuse);
      if (item.items.size() == 3) field.components = components_of(item.items[2], where, refuse);
      bytes = field.bytes();
      out.fields.push_back(std::move(field));
    }
    if (bytes > std::numeric_limits<std::size_t>::max() - out.record_bytes) refuse("descr: the fields' sizes overflow");
    out.record_bytes += bytes;
  }
}

// {'names': [...], 'formats': [...], 'offsets': [...], 'itemsize': n}
void read_field_table(const Literal& descr, NpyHeader& out, const Refusal& refuse) {
  for (const std::string& key : descr.keys) {
    if (key != "names" && key != "formats" && key != "offsets" && key != "itemsize") {
      refuse(fmt::format("descr: unknown key '{}'; expected names, formats, offsets and itemsize", shown(key)));
    }
  }
  const Literal *names = descr.find("names"), *formats = descr.find("formats"), *offsets = descr.find("offsets"),
                *itemsize = descr.find("itemsize");
  if (!names || !formats || !names->is_sequence() || !formats->is_sequence() || names->items.size() != formats->items.size()) {
    refuse("descr: expected names and formats, equally many");
  }
  if (offsets && (!offsets->is_sequence() || offsets->items.size() != names->items.size())) {
    refuse("descr: expected as many offsets as names");
  }
  std::size_t end = 0;
  for (std::size_t i = 0; i < names->items.size(); ++i) {
    NpyField field{name_of(names->items[i], refuse), {}, end, 1};
    const std::string where = fmt::format("field '{}'", shown(field.name));
    const Literal& format = formats->items[i];
    const bool is_row = format.kind == Literal::tuple && format.items.size() == 2;
    field.type = number_type(is_row ? format.items[0] : format, where, refuse);
    if (is_row) field.components = components_of(format.items[1], where, refuse);
    if (offsets) {
      if (offsets->items[i].kind != Literal::integer) refuse(fmt::format("{}: expected a number as its offset", where));
      field.offset = offsets->items[i].number;
    }
    if (field.offset > std::numeric_limits<std::size_t>::max() - field.bytes()) {
      refuse(fmt::format("{}: its offset {} overflows", where, field.offset));
    }
    end = std::max(end, field.offset + field.bytes());
    out.fields.push_back(std::move(field));
  }
  out.record_bytes = end;
  if (itemsize) {
    if (itemsize->kind != Literal::integer || itemsize->number < end) {
      refuse(fmt::format("descr: itemsize must be at least {}, the end of the last field", end));
    }
    out.record_bytes = itemsize->number;
  }
}

void check_fields(NpyHeader& out, const Refusal& refuse) {
  if (out.fields.empty()) refuse("descr: no fields");
  std::set<std::string_view> names;
  for (const NpyField& field : out.fields) {
    if (field.name.empty()) refuse("descr: a field without a name");
    if (!names.insert(field.name).second) refuse(fmt::format("descr: two fields named '{}'", shown(field.name)));
  }
  std::ranges::stable_sort(out.fields, {}, &NpyField::offset);
  for (std::size_t i = 1; i < out.fields.size(); ++i) {
    if (out.fields[i].offset < out.fields[i - 1].offset + out.fields[i - 1].bytes()) {
      refuse(fmt::format("fields '{}' and '{}' overlap", shown(out.fields[i - 1].name), shown(out.fields[i].name)));
    }
  }
}

void read_type(const Literal& descr, NpyHeader& out, const Refusal& refuse) {
  if (descr.kind == Literal::string) {
    out.type = number_type(descr, "descr", refuse);
    out.record_bytes = type_bytes(out.type);
    return;
  }
  if (descr.kind == Literal::list) {
    read_field_list(descr, out, refuse);
  } else if (descr.kind == Literal::dictionary) {
    read_field_table(descr, out, refuse);
  } else {
    refuse(fmt::format("descr: expected {} or a list of fields", accepted));
  }
  check_fields(out, refuse);
}

void read_shape(const Literal& shape, NpyHeader& out, const Refusal& refuse) {
  if (shape.kind != Literal::tuple) refuse("shape: expected a tuple of numbers, as (480, 640, 4)");
  for (const Literal& side : shape.items) {
    if (side.kind != Literal::integer) refuse("shape: expected a tuple of numbers, as (480, 640, 4)");
    out.shape.push_back(side.number);
  }
}

// Returns the dictionary as text, and the offset of the data.
std::string_view header_text(std::span<const std::byte> file, std::size_t& data_offset, const Refusal& refuse) {
  constexpr std::size_t after_version = signature.size() + 2;
  const std::size_t compared = std::min(file.size(), signature.size());
  if (file.empty()) refuse("empty file");
  if (std::memcmp(file.data(), signature.data(), compared) != 0) refuse("not a .npy file: it does not start with \\x93NUMPY");
  if (file.size() < after_version) refuse("truncated in its .npy header");
  const int major = std::to_integer<int>(file[6]), minor = std::to_integer<int>(file[7]);
  if (major < 1 || major > 3 || minor != 0) {
    refuse(fmt::format("version {}.{} of .npy; expected 1.0, 2.0 or 3.0", major, minor));
  }
  const std::size_t length_bytes = major == 1 ? 2 : 4;
  if (file.size() < after_version + length_bytes) refuse("truncated in its .npy header");
  std::size_t length = 0;
  for (std::size_t i = 0; i < length_bytes; ++i) length |= std::to_integer<std::size_t>(file[after_version + i]) << 8 * i;
  if (length > longest_header) refuse(fmt::format("a .npy header of {} bytes; the longest read is {}", length, longest_header));
  data_offset = after_version + length_bytes + length;
  if (data_offset > file.size()) {
    refuse(fmt::format("truncated in its .npy header: {} bytes of {}", file.size(), data_offset));
  }
  return {reinterpret_cast<const char*>(file.data()) + after_version + length_bytes, length};
}

// Shape times type must equal the size of the data: one comparison finds truncation, trailing bytes and absurd shapes.
void check_size(const NpyHeader& header, std::size_t file_size, const Refusal& refuse) {
  const std::size_t found = file_size - header.data_offset;
  std::optional<std::size_t> expected = header.record_bytes;
  // A side of 0 makes the product 0, whatever the others are.
  if (std::ranges::find(header.shape, 0u) != header.shape.end()) expected = 0;
  for (const std::size_t side : header.shape) {
    if (expected) expected = checked_product(*expected, side);
  }
  const std::string what = fmt::format("shape ({}) of {} bytes each", fmt::join(header.shape, ", "), header.record_bytes);
  if (!expected) refuse(fmt::format("{} overflows; {} bytes of data found", what, found));
  if (found < *expected) refuse(fmt::format("truncated: {} needs {} bytes of data, found {}", what, *expected, found));
  if (found > *expected)
    refuse(fmt::format("{} bytes too many: {} needs {} bytes of data, found {}", found - *expected, what, *expected, found));
}

}  // namespace

std::size_t NpyField::bytes() const { return type_bytes(type) * components; }

std::size_t NpyHeader::elements() const {
  std::size_t out = 1;
  for (const std::size_t side : shape) out *= side;
  return out;
}

NpyHeader parse_npy_header(std::span<const std::byte> file, std::string_view name) {
  const Refusal refuse{name};
  NpyHeader out;
  const std::string_view text = header_text(file, out.data_offset, refuse);
  const auto header = parse_python_literal(text);
  if (!header || header->kind != Literal::dictionary) {
    refuse(fmt::format("its .npy header is no dictionary of descr, fortran_order and shape: '{}'", shown(text)));
  }
  const std::array<std::string, 3> keys{"descr", "fortran_order", "shape"};
  for (const std::string& key : header->keys) {
    if (std::ranges::find(keys, key) == keys.end()) {
      refuse(fmt::format("unknown key '{}' in its .npy header{}", shown(key), did_you_mean(shown(key), keys)));
    }
  }
  for (const std::string& key : keys) {
    if (!header->find(key)) refuse(fmt::format("no '{}' in its .npy header", key));
  }
  const Literal& fortran_order = *header->find("fortran_order");
  if (fortran_order.kind != Literal::boolean) refuse("fortran_order: expected True or False");
  if (fortran_order.number == 1) {
    refuse("Fortran order: its columns lie where rows are expected; save numpy.ascontiguousarray(a)");
  }
  read_type(*header->find("descr"), out, refuse);
  read_shape(*header->find("shape"), out, refuse);
  check_size(out, file.size(), refuse);
  return out;
}

}  // namespace rainref::capture
