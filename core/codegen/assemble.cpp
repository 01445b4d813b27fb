// The one place that knows instructions: Xbyak encodes what the allocation has decided. AVX-512 has
// the instructions of AVX2 on more and wider registers, but for masks: there a comparison sets a
// register of one bit a lane. Since masks are values like others here, the bits are spread at once,
// and `select` is logic on them.
#include "core/codegen/written_code.h"

#if defined(__x86_64__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#include <xbyak/xbyak.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <array>
#include <type_traits>

namespace linkstudy::codegen {
namespace {

constexpr std::size_t kLongest = 24;  // bytes an instruction of a program: at most two of 12
constexpr std::size_t kAround = 12;   // instructions before and behind a program
constexpr std::uint8_t kLess = 1, kLessEqual = 2, kEqual = 0;  // predicates, ordered

constexpr std::uint8_t kUpperHalves = 0xf5;  // of each 64 bits, in vpshufd

// Truth tables of vpternlogq x, y, z: bit 4 x + 2 y + z is what the three bits give.
constexpr std::uint8_t kXThenZElseY = 0xac, kYThenXElseZ = 0xe2, kYThenZElseX = 0xb8;

// Vector: ymm or zmm registers.
template <class Vector>
class Assembler : public Xbyak::CodeGenerator {
 public:
  static constexpr bool is_wide = std::is_same_v<Vector, Xbyak::Zmm>;
  static constexpr InstructionSet kSet = is_wide ? InstructionSet::avx512 : InstructionSet::avx2;

  Assembler(const FrameLayout& layout, std::size_t size, std::uint8_t* memory)
      : CodeGenerator(size, memory), layout_(layout) {}

  void write(const Program& program) {
    place_bases(program.slots);
    for (const Instruction& i : program.instructions) {
      for (frame_ = 0; frame_ < layout_.frames; ++frame_) write(i);
    }
    vzeroupper();
    ret();
  }

 private:
  Vector reg(int i) const { return Vector(frame_ * registers_ + i); }

  // A slot is reached from the nearest of several places in its frame: AVX-512 counts distances in
  // vectors, 128 of which take one byte of the instruction in place of four. Long code runs as fast
  // as its bytes are fetched.
  void place_bases(int slots) {
    const auto most = kBases.size() / static_cast<std::size_t>(layout_.frames);
    if (is_wide && slots > kReach / 2) {
      middle_ = kReach / 2;
      bases_ = std::min(static_cast<std::size_t>((slots + kReach - 1) / kReach), most);
    }
    const std::size_t all = bases_ * static_cast<std::size_t>(layout_.frames);
    for (std::size_t i = all; i-- > 0;) {
      const int place = place_of(i % bases_) + static_cast<int>(i / bases_) * frame_bytes_;
      if (i > 0 || place > 0) lea(kBases[i], ptr[rdi + place]);
    }
  }
  int place_of(std::size_t base) const {
    return (static_cast<int>(base) * kReach + middle_) * slot_bytes_;
  }
  Xbyak::Address memory(int slot) const {
    const std::size_t base = std::min(static_cast<std::size_t>(slot / kReach), bases_ - 1);
    return ptr[kBases[static_cast<std::size_t>(frame_) * bases_ + base] +
               (slot * slot_bytes_ - place_of(base))];
  }

  // f of the operand, a register or a place in memory.
  template <class F>
  void with(const Operand& o, F&& f) {
    if (o.reg >= 0) {
      f(reg(o.reg));
    } else {
      f(memory(o.slot));
    }
  }

  void write(const Instruction& i) {
    switch (i.action) {
      case Action::load:
        return vmovapd(reg(i.to), memory(i.first.slot));
      case Action::store:
        return vmovapd(memory(i.first.slot), reg(i.to));
      case Action::copy:
        return vmovapd(reg(i.to), reg(i.first.reg));
      case Action::operate:
        return is_fused(i.op) ? write_fused(i) : write_operation(i);
    }
  }

  void write_operation(const Instruction& i) {
    const Vector to = reg(i.to), a = reg(std::max(i.first.reg, 0));
    switch (i.op) {
      case Op::square_root:
        return with(i.first, [&](const auto& x) { vsqrtpd(to, x); });
      case Op::sign_mask:
        return spread_sign(to, a);
      case Op::select:
        return with(i.second, [&](const auto& x) { choose(to, a, x, reg(i.third.reg)); });
      default:
        return with(i.second, [&](const auto& x) { write_pair(i.op, to, a, x); });
    }
  }

  // to := mask ? a : b
  void choose(const Vector& to, const Vector& mask, const Xbyak::Operand& a, const Vector& b) {
    if constexpr (!is_wide) {
      vblendvpd(to, b, a, mask);
    } else if (a.isZMM() && a.getIdx() == to.getIdx()) {
      vpternlogq(to, mask, b, kYThenXElseZ);
    } else if (b.getIdx() == to.getIdx()) {
      vpternlogq(to, mask, a, kYThenZElseX);
    } else {
      if (mask.getIdx() != to.getIdx()) vmovapd(to, mask);
      vpternlogq(to, b, a, kXThenZElseY);
    }
  }

  // The sign to all bits; AVX2 shifts no 64 bits so, but halves of them.
  void spread_sign(const Vector& to, const Vector& a) {
    if constexpr (is_wide) {
      vpsraq(to, a, 63);
    } else {
      vpsrad(to, a, 31);
      vpshufd(to, to, kUpperHalves);
    }
  }

  // To all bits or none.
  void compare(std::uint8_t predicate, const Vector& to, const Vector& a, const Xbyak::Operand& b) {
    if constexpr (is_wide) {
      const Xbyak::Opmask bits(1 + frame_);
      vcmppd(bits, a, b, predicate);
      vpmovm2q(to, bits);
    } else {
      vcmppd(to, a, b, predicate);
    }
  }

  void write_pair(Op op, const Vector& to, const Vector& a, const Xbyak::Operand& b) {
    switch (op) {
      case Op::add:
        return vaddpd(to, a, b);
      case Op::subtract:
        return vsubpd(to, a, b);
      case Op::multiply:
        return vmulpd(to, a, b);
      case Op::divide:
        return vdivpd(to, a, b);
      case Op::minimum:
        return vminpd(to, a, b);
      case Op::maximum:
        return vmaxpd(to, a, b);
      case Op::bit_and:
        return vandpd(to, a, b);
      case Op::bit_or:
        return vorpd(to, a, b);
      case Op::bit_xor:
        return vxorpd(to, a, b);
      case Op::shift_left:
        return vpsllvq(to, a, b);
      case Op::shift_right:
        return vpsrlvq(to, a, b);
      case Op::less:
        return compare(kLess, to, a, b);
      case Op::less_equal:
        return compare(kLessEqual, to, a, b);
      default:
        return compare(kEqual, to, a, b);
    }
  }

  void write_fused(const Instruction& i) {
    with(i.second, [&](const auto& z) {
      const Vector x = reg(i.to), y = reg(i.first.reg);
      switch (i.form) {
        case FusedForm::x_y_plus_z:
          return write_213(i.op, x, y, z);
        case FusedForm::x_z_plus_y:
          return write_132(i.op, x, y, z);
        case FusedForm::y_z_plus_x:
          return write_231(i.op, x, y, z);
      }
    });
  }

  void write_213(Op op, const Vector& x, const Vector& y, const Xbyak::Operand& z) {
    if (op == Op::madd) return vfmadd213pd(x, y, z);
    if (op == Op::msub) return vfmsub213pd(x, y, z);
    if (op == Op::nmadd) return vfnmadd213pd(x, y, z);
    vfnmsub213pd(x, y, z);
  }
  void write_132(Op op, const Vector& x, const Vector& y, const Xbyak::Operand& z) {
    if (op == Op::madd) return vfmadd132pd(x, y, z);
    if (op == Op::msub) return vfmsub132pd(x, y, z);
    if (op == Op::nmadd) return vfnmadd132pd(x, y, z);
    vfnmsub132pd(x, y, z);
  }
  void write_231(Op op, const Vector& x, const Vector& y, const Xbyak::Operand& z) {
    if (op == Op::madd) return vfmadd231pd(x, y, z);
    if (op == Op::msub) return vfmsub231pd(x, y, z);
    if (op == Op::nmadd) return vfnmadd231pd(x, y, z);
    vfnmsub231pd(x, y, z);
  }

  static constexpr int kReach = 256;  // slots about a base
  const std::array<Xbyak::Reg64, 9> kBases{rdi, rsi, rdx, rcx, r8, r9, r10, r11, rax};

  const FrameLayout layout_;
  const int slot_bytes_ = 8 * layout_.slot_numbers;
  const int frame_bytes_ = layout_.slots * slot_bytes_;
  const int registers_ = program_registers(kSet, layout_.frames);
  int frame_ = 0;          // of the instruction
  std::size_t bases_ = 1;  // of a frame
  int middle_ = 0;         // slot that the first is at
};

template <class Vector>
std::vector<std::uint8_t> assemble_with(const Program& program, const FrameLayout& layout) {
  const std::size_t instructions =
      static_cast<std::size_t>(layout.frames) * program.instructions.size() + kAround;
  std::vector<std::uint8_t> code(instructions * kLongest);
  Assembler<Vector> assembler(layout, code.size(), code.data());
  assembler.write(program);
  code.resize(assembler.getSize());
  return code;
}

}  // namespace

std::vector<std::uint8_t> assemble(const Program& program, InstructionSet isa,
                                   const FrameLayout& layout) {
  switch (isa) {
    case InstructionSet::avx512:
      return assemble_with<Xbyak::Zmm>(program, layout);
    case InstructionSet::avx2:
      return assemble_with<Xbyak::Ymm>(program, layout);
    case InstructionSet::baseline:
      break;
  }
  return {};
}

}  // namespace linkstudy::codegen

#else

namespace linkstudy::codegen {

std::vector<std::uint8_t> assemble(const Program&, InstructionSet, const FrameLayout&) {
  return {};
}

}  // namespace linkstudy::codegen

#endif
