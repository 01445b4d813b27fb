// What the bytes of written code mean, read back by a disassembler and carried out in plain C++:
// for AVX-512 too, whatever this machine can run.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/codegen/written_code.h"
#include "tests/core/codegen/drawn_graphs.h"
#include "tests/support/disassembled.h"

namespace linkstudy::testing::disassembly_test {
namespace {

using codegen::Graph;
using codegen::Op;
using codegen::Program;
using codegen::Value;

// A graph of n inputs whose outputs follow them.
struct Wanted {
  const Graph* graph;
  int inputs, slots;
};

class Disassembly : public ::testing::TestWithParam<Target> {
 protected:
  void SetUp() override {
    if (GetParam().assemble({}).empty()) GTEST_SKIP() << "another processor";
    if (!has_disassembler()) GTEST_SKIP() << "no objdump here";
  }

  void expect_meaning(const std::vector<Wanted>& all, std::mt19937_64& random, int runs) {
    std::vector<Program> programs;
    std::vector<std::vector<std::uint8_t>> codes;
    for (const Wanted& w : all) {
      programs.push_back(GetParam().allocate(*w.graph, w.slots));
      codes.push_back(GetParam().assemble(programs.back()));
    }
    read_ = Disassembled::read(codes);
    ASSERT_EQ(read_.size(), all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (int run = 0; run < runs; ++run) {
        DrawnFrames frames(*all[i].graph, programs[i], all[i].inputs, all[i].slots, GetParam(),
                           random);
        read_[i].run(frames.numbers());
        ASSERT_TRUE(frames.are_as_expected()) << "graph " << i;
      }
    }
  }

  std::vector<Disassembled> read_;
};

using Operand = Disassembled::Operand;

// The greatest f(operand) among operands of a kind.
template <class F>
std::uint64_t greatest(const std::vector<Disassembled>& all, Operand::Kind kind, F&& f) {
  std::uint64_t found = 0;
  for (const Disassembled& d : all) {
    for (const auto& i : d.instructions()) {
      for (const Operand& o : i.operands)
        if (o.kind == kind) found = std::max<std::uint64_t>(found, f(o));
    }
  }
  return found;
}

std::uint64_t number_of(const Operand& o) {
  return o.number;
}
std::uint64_t base_of(const Operand& o) {
  return o.base;
}
std::uint64_t distance_of(const Operand& o) {
  return static_cast<std::uint64_t>(std::abs(static_cast<std::int64_t>(o.number)));
}

TEST_P(Disassembly, Of_random_graphs_computes_what_they_say) {
  std::vector<std::unique_ptr<DrawnGraph>> drawn;
  std::vector<Wanted> all;
  for (std::uint64_t seed = 1000; seed < 1200; ++seed) {
    drawn.push_back(std::make_unique<DrawnGraph>(seed, seed % 8 == 1 ? 2000 : 200));
    all.push_back({&drawn.back()->graph, drawn.back()->inputs, drawn.back()->slots});
  }
  Graph wide;  // reaches far into its frame
  Value sum = wide.input(0);
  constexpr int kFar = 2600;
  for (int i = 1; i < kFar; ++i) sum = wide.make(Op::madd, wide.input(i), wide.input(i - 1), sum);
  wide.write(sum, kFar);
  all.push_back({&wide, kFar, kFar + 1});
  std::mt19937_64 random(11);
  expect_meaning(all, random, 1);
  // All registers are used, and offsets of one byte, which count slots there, and of four.
  EXPECT_EQ(greatest(read_, Operand::Kind::vector, number_of),
            vector_registers(GetParam().isa) - 1u);
  EXPECT_EQ(greatest(read_, Operand::Kind::memory, base_of), GetParam().isa == InstructionSet::avx2
                                                                 ? 0u
                                                             : GetParam().frames == 1 ? 8u
                                                                                      : 7u);
  EXPECT_GT(greatest(read_, Operand::Kind::memory, distance_of),
            128u * 8u * static_cast<unsigned>(GetParam().slot_numbers));
}

// Every operation, with its operands in each place, on numbers of all kinds.
TEST_P(Disassembly, Of_each_operation_is_this_operation) {
  std::vector<std::unique_ptr<Graph>> graphs;
  std::vector<Wanted> all;
  for (int op = static_cast<int>(Op::add); op <= static_cast<int>(Op::select); ++op) {
    for (int order = 0; order < 6; ++order) {
      graphs.push_back(std::make_unique<Graph>());
      Graph& graph = *graphs.back();
      std::vector<Value> x = {graph.input(0), graph.input(1), graph.input(2)};
      for (int i = 0; i < order; ++i) std::next_permutation(x.begin(), x.end());
      const bool is_choice = static_cast<Op>(op) == Op::select;
      if (is_choice) x[0] = graph.make(Op::less, graph.input(0), graph.input(1));
      const int count = codegen::operand_count(static_cast<Op>(op));
      graph.write(
          graph.make(static_cast<Op>(op), x[0], count > 1 ? x[1] : -1, count > 2 ? x[2] : -1), 3);
      // Operands that are used again stay, those that are not are overwritten.
      const bool stay = order % 2 == 0;
      for (int i = 0; i < 3 && stay; ++i)
        graph.write(graph.make(Op::add, graph.input(i), graph.input(2)), 4 + i);
      all.push_back({&graph, 3, stay ? 7 : 4});
    }
  }
  std::mt19937_64 random(12);
  expect_meaning(all, random, 40);
}

// Encodings that a reader can hold against the manual.
TEST_P(Disassembly, Of_a_comparison_and_a_choice_is_short) {
  Graph graph;
  const Value x = graph.input(0), y = graph.input(1);
  graph.write(graph.make(Op::select, graph.make(Op::less_equal, x, y), x, y), 2);
  std::mt19937_64 random(13);
  expect_meaning({{&graph, 2, 3}}, random, 10);
  std::vector<std::string> mnemonics;
  for (const auto& i : read_.front().instructions()) mnemonics.push_back(i.mnemonic);
  const bool is_wide = GetParam().isa == InstructionSet::avx512;
  std::vector<std::string> wide = {"vmovapd",    "vmovapd", "vcmplepd",   "vpmovm2q",
                                   "vpternlogq", "vmovapd", "vzeroupper", "ret"};
  if (GetParam().frames == 2) {
    wide = {"lea",        "vmovapd",  "vmovapd",  "vmovapd",    "vmovapd",
            "vcmplepd",   "vpmovm2q", "vcmplepd", "vpmovm2q",   "vpternlogq",
            "vpternlogq", "vmovapd",  "vmovapd",  "vzeroupper", "ret"};
  }
  const std::vector<std::string> narrow = {"vmovapd", "vmovapd",    "vcmplepd", "vblendvpd",
                                           "vmovapd", "vzeroupper", "ret"};
  EXPECT_EQ(mnemonics, is_wide ? wide : narrow);
}

TEST_P(Disassembly, Finds_an_instruction_that_is_not_there) {
  const std::vector<std::vector<std::uint8_t>> code = {{0x0f, 0x0b, 0xc3}};  // ud2; ret
  std::vector<double> frame(8);
  EXPECT_THROW(Disassembled::read(code).front().run(frame), std::runtime_error);
}

INSTANTIATE_TEST_SUITE_P(Of, Disassembly,
                         ::testing::Values(Target{InstructionSet::avx2, 4},
                                           Target{InstructionSet::avx512, 8},
                                           Target{InstructionSet::avx512, 8, 2}),
                         [](const auto& of) { return of.param.name(); });

}  // namespace
}  // namespace linkstudy::testing::disassembly_test
