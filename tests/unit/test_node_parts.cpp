// What ranks do with rows of arrays is the same whether the communicator reaches them or copies of them, as on devices.
#include <skein/arrays/combination.hpp>

#include "src/physics/node_parts.hpp"
#include "tests/reference/point_cloud.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace skein {
namespace {

using Nodes = std::vector<Vec3>;

double component(const Vec3& v, const std::size_t c) { return c == 0 ? v.x : c == 1 ? v.y : v.z; }

bool is_same(const double a, const double b) { return std::memcmp(&a, &b, sizeof a) == 0; }
bool is_same(const Nodes& a, const Nodes& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

/// One of several ranks, which knows what the others have of one array: columns come in the order x, y, z.
class KnowingRank final : public Communicator {
 public:
  KnowingRank(const int rank, const RankParts& owners, const Nodes& all) : rank_(rank), owners_(owners), all_(all) {}
  int rank() const override { return rank_; }
  int size() const override { return static_cast<int>(owners_.count.size()); }
  std::string describe() const override { return "a rank that knows"; }
  void broadcast(void*, std::size_t) override { FAIL(); }
  void gather(const double* own, const RankParts&, double* all) override {
    expect_own(own, next_);
    for (std::size_t i = 0; rank_ == 0 && i < all_.size(); ++i) all[i] = component(all_[i], next_);
    ++next_;
  }
  void gather_to_all(const std::vector<double*>& columns, const RankParts&) override {
    ASSERT_EQ(columns.size(), 3u);
    for (std::size_t c = 0; c < 3; ++c) {
      expect_own(columns[c] + owners_.first[here()], c);
      for (std::size_t i = 0; i < all_.size(); ++i)
        if (i < owners_.first[here()] || i >= owners_.first[here()] + owners_.count[here()])
          columns[c][i] = component(all_[i], c);
    }
  }
  void exchange(const double* send, const RankParts& sent, double* receive, const RankParts& received) override {
    EXPECT_EQ(sent.total(), rank_ == 0 ? all_.size() : 0u);
    for (std::size_t i = 0; i < sent.total(); ++i) EXPECT_TRUE(is_same(send[i], component(all_[i], next_)));
    ASSERT_EQ(received.count[0], owners_.count[here()]);
    for (std::size_t i = 0; i < received.count[0]; ++i) receive[i] = component(all_[owners_.first[here()] + i], next_);
    ++next_;
  }
  [[noreturn]] void fail(int, const std::string&) override { std::abort(); }

 private:
  std::size_t here() const { return static_cast<std::size_t>(rank_); }
  void expect_own(const double* own, const std::size_t c) const {
    for (std::size_t i = 0; i < owners_.count[here()]; ++i)
      ASSERT_TRUE(is_same(own[i], component(all_[owners_.first[here()] + i], c)))
          << "row " << i << " of rank " << rank_;
  }

  int rank_;
  const RankParts& owners_;
  const Nodes& all_;
  std::size_t next_ = 0;
};

/// One of several ranks, asked in turn, rank 0 last: it has what the others have sent.
class LastRankIsZero final : public Communicator {
 public:
  explicit LastRankIsZero(const int size) : sent_(static_cast<std::size_t>(size)) {}
  void be(const int rank) { rank_ = rank; }
  int rank() const override { return rank_; }
  int size() const override { return static_cast<int>(sent_.size()); }
  std::string describe() const override { return "ranks in turn"; }
  void broadcast(void*, std::size_t) override { FAIL(); }
  void gather_to_all(const std::vector<double*>&, const RankParts&) override { FAIL(); }
  void exchange(const double*, const RankParts&, double*, const RankParts&) override { FAIL(); }
  void gather(const double* own, const RankParts& parts, double* all) override {
    const auto here = static_cast<std::size_t>(rank_);
    sent_[here].assign(own, own + parts.count[here]);
    for (std::size_t r = 0; rank_ == 0 && r < sent_.size(); ++r) {
      ASSERT_EQ(sent_[r].size(), parts.count[r]);
      std::copy(sent_[r].begin(), sent_[r].end(), all + parts.first[r]);
    }
  }
  [[noreturn]] void fail(int, const std::string&) override { std::abort(); }

 private:
  int rank_ = 0;
  std::vector<std::vector<double>> sent_;
};

Nodes make_nodes(const std::size_t n, const unsigned seed) {
  reference::Random random(seed);
  return reference::make_random_vectors(static_cast<int>(n), 1.0, random);
}

/// Few nodes and many, some ranks of none; chunks of dot products that are several ranks'.
const std::vector<std::vector<std::size_t>> counts = {{700}, {0, 300}, {257, 0, 511, 1}, {64, 64, 64}, {3, 2000, 900}};

class NodePartsTest : public ::testing::TestWithParam<RowAccess> {
 protected:
  static Vectors part_of(const Nodes& all, const RankParts& owners, const int rank) {
    const auto first = static_cast<std::ptrdiff_t>(owners.first[static_cast<std::size_t>(rank)]);
    const auto n = static_cast<std::ptrdiff_t>(owners.count[static_cast<std::size_t>(rank)]);
    const Vectors part = make_part("part", owners, rank);
    if (n > 0)
      Kokkos::deep_copy(own_rows(part, owners, rank),
                        to_device("own", Nodes(all.begin() + first, all.begin() + first + n)));
    return part;
  }
  /// Calls use(ranks, owners, all nodes) for each rank.
  template <class Use>
  static void for_ranks(const Use& use) {
    for (const auto& count : counts) {
      const RankParts owners = RankParts::behind_each_other(count);
      for (int rank = 0; rank < static_cast<int>(count.size()); ++rank) {
        const Nodes all =
            make_nodes(owners.total(), 7 + static_cast<unsigned>(rank));  // nothing of it left from others
        KnowingRank ranks(rank, owners, all);
        use(ranks, owners, all);
      }
    }
  }
};

TEST_P(NodePartsTest, AreGatheredToAll) {
  for_ranks([](Communicator& ranks, const RankParts& owners, const Nodes& all) {
    const Vectors whole = to_device("whole", Nodes(all.size(), Vec3{std::nan(""), 1.0, 2.0}));
    gather_parts_to_all(ranks, owners, part_of(all, owners, ranks.rank()), whole, GetParam());
    EXPECT_TRUE(is_same(to_host(ConstVectors(whole)), all)) << "rank " << ranks.rank() << " of " << ranks.size();
  });
}

TEST_P(NodePartsTest, AreGatheredOnRankZero) {
  for_ranks([](Communicator& ranks, const RankParts& owners, const Nodes& all) {
    const Vectors whole("whole", ranks.rank() == 0 ? all.size() : 0);
    gather_parts(ranks, owners, part_of(all, owners, ranks.rank()), ranks.rank() == 0 ? whole : Vectors(), GetParam());
    if (ranks.rank() > 0) return;
    EXPECT_TRUE(is_same(to_host(ConstVectors(whole)), all)) << ranks.size();
  });
}

TEST_P(NodePartsTest, AreScattered) {
  for_ranks([](Communicator& ranks, const RankParts& owners, const Nodes& all) {
    const Vectors part = make_part("part", owners, ranks.rank());
    Kokkos::deep_copy(part, std::nan(""));
    scatter_parts(ranks, owners, ranks.rank() == 0 ? to_device("whole", all) : Vectors(), part, GetParam());
    const Vectors expected = part_of(all, owners, ranks.rank());
    if (owners.count[static_cast<std::size_t>(ranks.rank())] == 0) return;
    EXPECT_TRUE(is_same(to_host(ConstVectors(part)), to_host(ConstVectors(expected)))) << "rank " << ranks.rank();
  });
}

TEST_P(NodePartsTest, HaveTheDotProductsOfTheWhole) {
  for (const auto& count : counts) {
    const RankParts owners = RankParts::behind_each_other(count);
    const Nodes all = make_nodes(owners.total(), 3), others = make_nodes(owners.total(), 4);
    const Vectors whole = to_device("whole", all), other = to_device("other", others);
    LastRankIsZero ranks(static_cast<int>(count.size()));
    double squares = 0.0;
    for (int rank = ranks.size(); rank-- > 0;) {
      ranks.be(rank);
      const Vectors part = part_of(all, owners, rank);
      squares = add_up_products(ranks, owners, part, part, GetParam());
    }
    EXPECT_TRUE(is_same(squares, dot_product<ExecSpace>(ExecSpace(), whole, whole))) << count.size() << " ranks";
    EXPECT_GT(squares, 1.0);
    LastRankIsZero ranks_again(static_cast<int>(count.size()));
    double products = 0.0;
    for (int rank = ranks.size(); rank-- > 0;) {
      ranks_again.be(rank);
      products =
          add_up_products(ranks_again, owners, part_of(all, owners, rank), part_of(others, owners, rank), GetParam());
    }
    EXPECT_TRUE(is_same(products, dot_product<ExecSpace>(ExecSpace(), whole, other))) << count.size() << " ranks";
    EXPECT_LT(std::abs(products), squares) << "of vectors that have nothing to do with each other";
  }
}

INSTANTIATE_TEST_SUITE_P(, NodePartsTest, ::testing::Values(RowAccess::as_needed, RowAccess::by_copies),
                         [](const auto& access) { return std::string(access.index == 0 ? "as_needed" : "by_copies"); });

}  // namespace
}  // namespace skein
