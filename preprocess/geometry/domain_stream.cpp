#include "preprocess/geometry/domain_stream.hpp"

#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace tessera::preprocess {
namespace {

constexpr std::string_view magic = "TESSDOM1";
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
  void operator()(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* first = reinterpret_cast<const char*>(&value);
    bytes_.append(first, sizeof value);
  }
  void operator()(const Vec3& X) {
    for (int c = 0; c < 3; ++c)
      (*this)(X[c]);
  }
  void operator()(const Domain::Facet& facet) {
    (*this)(facet.vertices);
    (*this)(facet.surface);
    (*this)(facet.tet);
  }
  void operator()(const Domain::FeatureEdge& edge) {
    (*this)(edge.vertices);
    (*this)(edge.curve);
  }
  void operator()(const std::string& text) {
    (*this)(std::uint64_t{text.size()});
    bytes_ += text;
  }
  void operator()(const Domain::Group& group) {
    (*this)(group.name);
    (*this)(group.dimension);
    (*this)(group.surfaces);
    (*this)(group.curves);
    (*this)(group.vertices);
  }
  template <class T>
  void operator()(const std::vector<T>& values) {
    (*this)(std::uint64_t{values.size()});
    for (const T& value : values)
      (*this)(value);
  }
  std::string&& take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  void operator()(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
  }
  void operator()(Vec3& X) {
    for (int c = 0; c < 3; ++c)
      (*this)(X[c]);
  }
  void operator()(Domain::Facet& facet) {
    (*this)(facet.vertices);
    (*this)(facet.surface);
    (*this)(facet.tet);
  }
  void operator()(Domain::FeatureEdge& edge) {
    (*this)(edge.vertices);
    (*this)(edge.curve);
  }
  void operator()(std::string& text) { text = take(count(1)); }
  void operator()(Domain::Group& group) {
    (*this)(group.name);
    (*this)(group.dimension);
    (*this)(group.surfaces);
    (*this)(group.curves);
    (*this)(group.vertices);
  }
  template <class T>
  void operator()(std::vector<T>& values) {
    // Every element takes at least four bytes, so a false count cannot ask for more memory than the stream
    // has.
    values.resize(count(4));
    for (T& value : values)
      (*this)(value);
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
    (*this)(n);
    if (n > bytes_.size() / least_bytes_each)
      throw std::runtime_error("the domain ends early");
    return n;
  }
  std::string_view bytes_;
};

/// The members in the order of the stream, for either direction.
template <class Visitor, class DomainT>
void visit(Visitor& io, DomainT& domain) {
  io(domain.vertices);
  io(domain.tets);
  io(domain.facets);
  io(domain.feature_edges);
  io(domain.corners);
  io(domain.surfaces);
  io(domain.groups);
  io(domain.volume);
  io(domain.cad_volume);
  io(domain.lower);
  io(domain.upper);
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
