#include "preprocess/geometry/domain_stream.hpp"
#include "tests/support/domains.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace tessera::preprocess {
namespace {

TEST(DomainStream, gives_back_every_member) {
  Domain domain = test::l_domain(2, 1e-3, Vec3(1, -2, 3));
  domain.groups.push_back({"rim", 1, {}, {0, 5}, {}});
  domain.groups.push_back({"", 0, {}, {}, {7}});
  domain.cad_volume *= 1.001;
  const Domain back = from_bytes(to_bytes(domain));
  EXPECT_EQ(back.vertices, domain.vertices);
  EXPECT_EQ(back.tets, domain.tets);
  ASSERT_EQ(back.facets.size(), domain.facets.size());
  for (std::size_t f = 0; f < back.facets.size(); ++f) {
    EXPECT_EQ(back.facets[f].vertices, domain.facets[f].vertices);
    EXPECT_EQ(back.facets[f].surface, domain.facets[f].surface);
    EXPECT_EQ(back.facets[f].tet, domain.facets[f].tet);
  }
  ASSERT_EQ(back.feature_edges.size(), domain.feature_edges.size());
  for (std::size_t e = 0; e < back.feature_edges.size(); ++e) {
    EXPECT_EQ(back.feature_edges[e].vertices, domain.feature_edges[e].vertices);
    EXPECT_EQ(back.feature_edges[e].curve, domain.feature_edges[e].curve);
  }
  EXPECT_EQ(back.corners, domain.corners);
  EXPECT_EQ(back.surfaces, domain.surfaces);
  ASSERT_EQ(back.groups.size(), domain.groups.size());
  EXPECT_EQ(back.groups[8].name, "rim");
  EXPECT_EQ(back.groups[8].dimension, 1);
  EXPECT_EQ(back.groups[8].curves, (std::vector<std::int32_t>{0, 5}));
  EXPECT_EQ(back.groups[9].vertices, (std::vector<std::int32_t>{7}));
  EXPECT_EQ(back.volume, domain.volume);
  EXPECT_EQ(back.cad_volume, domain.cad_volume);
  EXPECT_EQ(back.lower, domain.lower);
  EXPECT_EQ(back.upper, domain.upper);
}

TEST(DomainStream, every_shortened_stream_is_refused) {
  const std::string bytes = to_bytes(test::box_domain());
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_THROW(from_bytes(std::string_view(bytes).substr(0, n)), std::runtime_error) << n;
  EXPECT_THROW(from_bytes(bytes + '\0'), std::runtime_error);
}

TEST(DomainStream, every_altered_byte_is_noticed) {
  const std::string bytes = to_bytes(test::box_domain());
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    std::string altered = bytes;
    altered[n] = static_cast<char>(altered[n] ^ 0x55);
    EXPECT_THROW(from_bytes(altered), std::runtime_error) << n;
  }
}

} // namespace
} // namespace tessera::preprocess
