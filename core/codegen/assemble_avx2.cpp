// The one place that knows an instruction set: Xbyak encodes what the allocation has decided.
#include "core/codegen/written_code.h"

#if defined(__x86_64__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#include <xbyak/xbyak.h>
#pragma GCC diagnostic pop

namespace linkstudy::codegen {
namespace {

constexpr std::size_t kLongest = 16;  // bytes an instruction, more than any takes
constexpr int kSlotBytes = 8 * kSlotNumbers;
constexpr std::uint8_t kLess = 1, kLessEqual = 2, kEqual = 0;  // predicates, ordered

class Assembler : public Xbyak::CodeGenerator {
 public:
  Assembler(std::size_t size, std::uint8_t* memory) : CodeGenerator(size, memory) {}

  void write(const Program& program) {
    for (const Instruction& i : program.instructions) write(i);
    vzeroupper();
    ret();
  }

 private:
  static Xbyak::Ymm reg(int i) { return Xbyak::Ymm(i); }
  Xbyak::Address memory(int slot) const { return ptr[rdi + slot * kSlotBytes]; }

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
    const Xbyak::Ymm to = reg(i.to), a = i.first.reg >= 0 ? reg(i.first.reg) : reg(0);
    switch (i.op) {
      case Op::square_root:
        return with(i.first, [&](const auto& x) { vsqrtpd(to, x); });
      case Op::shift_left:
        return vpsllq(to, a, 52);
      case Op::shift_right:
        return vpsrlq(to, a, 52);
      case Op::select:
        return with(i.second, [&](const auto& x) { vblendvpd(to, reg(i.third.reg), x, a); });
      default:
        return with(i.second, [&](const auto& x) { write_pair(i.op, to, a, x); });
    }
  }

  void write_pair(Op op, const Xbyak::Ymm& to, const Xbyak::Ymm& a, const Xbyak::Operand& b) {
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
      case Op::less:
        return vcmppd(to, a, b, kLess);
      case Op::less_equal:
        return vcmppd(to, a, b, kLessEqual);
      default:
        return vcmppd(to, a, b, kEqual);
    }
  }

  void write_fused(const Instruction& i) {
    with(i.second, [&](const auto& z) {
      const Xbyak::Ymm x = reg(i.to), y = reg(i.first.reg);
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

  void write_213(Op op, const Xbyak::Ymm& x, const Xbyak::Ymm& y, const Xbyak::Operand& z) {
    if (op == Op::madd) return vfmadd213pd(x, y, z);
    if (op == Op::msub) return vfmsub213pd(x, y, z);
    if (op == Op::nmadd) return vfnmadd213pd(x, y, z);
    vfnmsub213pd(x, y, z);
  }
  void write_132(Op op, const Xbyak::Ymm& x, const Xbyak::Ymm& y, const Xbyak::Operand& z) {
    if (op == Op::madd) return vfmadd132pd(x, y, z);
    if (op == Op::msub) return vfmsub132pd(x, y, z);
    if (op == Op::nmadd) return vfnmadd132pd(x, y, z);
    vfnmsub132pd(x, y, z);
  }
  void write_231(Op op, const Xbyak::Ymm& x, const Xbyak::Ymm& y, const Xbyak::Operand& z) {
    if (op == Op::madd) return vfmadd231pd(x, y, z);
    if (op == Op::msub) return vfmsub231pd(x, y, z);
    if (op == Op::nmadd) return vfnmadd231pd(x, y, z);
    vfnmsub231pd(x, y, z);
  }
};

}  // namespace

std::vector<std::uint8_t> assemble_avx2(const Program& program) {
  std::vector<std::uint8_t> code((program.instructions.size() + 2) * kLongest);
  Assembler assembler(code.size(), code.data());
  assembler.write(program);
  code.resize(assembler.getSize());
  return code;
}

}  // namespace linkstudy::codegen

#else

namespace linkstudy::codegen {

std::vector<std::uint8_t> assemble_avx2(const Program&) {
  return {};
}

}  // namespace linkstudy::codegen

#endif
