#include "preprocess/geometry/domain_stream.hpp"

#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace tessera::preprocess {
namespace {

constexpr std::string_view magic = "TESSDOM2";
constexpr std::uint32_t byte_order = 0x01020304;

std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const char c : bytes)
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return hash;
}

class Writer {
 public:
  template <class T>
  void number(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void text(const std::string& value) {
    number(std::uint64_t{value.size()});
    bytes_ += value;
  }
  template <class T>
  void size(const std::vector<T>& values) {
    number(std::uint64_t{values.size()});
  }
  std::string&& take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  void number(T& value) {
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
  }
  void text(std::string& value) { value = take(count(1)); }
  template <class T>
  void size(std::vector<T>& values) {
    // Every element takes at least four bytes, so a false count cannot ask for more memory than the stream
    // has.
    values.resize(count(4));
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  std::string_view take(std::size_t n) {
    if (n > bytes_.size())
      throw std::runtime_error("the domain ends early");
    const std::string_view head = bytes_.substr(0, n);
    bytes_.remove_prefix(n);
    return head;
  }
  std::size_t count(std::size_t least_bytes_each) {
    std::uint64_t n = 0;
    number(n);
    if (n > bytes_.size() / least_bytes_each)
      throw std::runtime_error("the domain ends early");
    return n;
  }
  std::string_view bytes_;
};

/// Members in the order of the stream, for either direction. T is a type of Domain's, const for a Writer.
template <class IO, class T>
void visit(IO& io, T& value) {
  using Type = std::remove_const_t<T>;
  const auto members = [&io](auto&... member) { (visit(io, member), ...); };
  if constexpr (std::is_arithmetic_v<Type>)
    io.number(value);
  else if constexpr (std::is_same_v<Type, std::string>)
    io.text(value);
  else if constexpr (std::is_same_v<Type, Domain::Facet>)
    members(value.vertices, value.surface, value.tet);
  else if constexpr (std::is_same_v<Type, Domain::FeatureEdge>)
    members(value.vertices, value.curve);
  else if constexpr (std::is_same_v<Type, Domain::Group>)
    members(value.name, value.dimension, value.surfaces, value.curves, value.vertices);
  else if constexpr (std::is_same_v<Type, Domain>)
    members(value.dimension, value.vertices, value.tets, value.facets, value.feature_edges, value.corners,
            value.surfaces, value.groups, value.volume, value.cad_volume, value.lower, value.upper);
  else { // vectors, arrays and points
    if constexpr (requires { value.capacity(); })
      io.size(value);
    for (auto& element : value)
      visit(io, element);
  }
}

} // namespace

std::string to_bytes(const Domain& domain) {
  Writer writer;
  visit(writer, domain);
  std::string bytes{magic};
  bytes.append(reinterpret_cast<const char*>(&byte_order), sizeof byte_order);
  bytes += writer.take();
  const std::uint64_t hash = fnv1a(bytes);
  bytes.append(reinterpret_cast<const char*>(&hash), sizeof hash);
  return bytes;
}

Domain from_bytes(std::string_view bytes) {
  std::uint64_t hash = 0;
  std::uint32_t order = 0;
  const std::size_t head = magic.size() + sizeof order;
  if (bytes.size() < head + sizeof hash)
    throw std::runtime_error("the domain ends early");
  if (bytes.substr(0, magic.size()) != magic)
    throw std::runtime_error("not a domain of this version");
  std::memcpy(&order, bytes.data() + magic.size(), sizeof order);
  if (order != byte_order)
    throw std::runtime_error("a domain of another byte order");
  const std::string_view body = bytes.substr(head, bytes.size() - head - sizeof hash);
  std::memcpy(&hash, bytes.data() + head + body.size(), sizeof hash);

  Reader reader(body);
  Domain domain;
  visit(reader, domain);
  if (!reader.at_end())
    throw std::runtime_error("the domain has bytes left over");
  if (fnv1a(bytes.substr(0, head + body.size())) != hash)
    throw std::runtime_error("the domain was altered on its way");
  return domain;
}

} // namespace tessera::preprocess
