// The S-box of AES as a circuit of 113 gates and four inversions (Boyar and Peralta, A New
// Combinational Logic Minimization Technique with Applications to Cryptology, 2010, section 4; the
// names are the paper's). It inverts each byte in GF(2^8) by way of GF(2^4), then applies the
// affine map of FIPS 197, section 5.1.1.
//
// There is no table look-up, because look-ups leave traces in the data cache. Others on the chip or
// on the wire could learn the index from them.
#include "authentication/planes.hpp"

namespace iog::authentication {
namespace {

using Word = std::uint32_t;

// Linear forms of the byte's bits, the factors of all products; [0] is the lowest bit itself.
using Forms = std::array<Word, 22>;

// The top linear layer. As in the paper, x0 is the highest bit.
constexpr Forms forms_of(const Planes& planes) {
  const auto [x7, x6, x5, x4, x3, x2, x1, x0] = planes;
  Forms y{};
  const Word t0 = x1 ^ x2;
  y[0] = x7;
  y[14] = x3 ^ x5;
  y[13] = x0 ^ x6;
  y[9] = x0 ^ x3;
  y[8] = x0 ^ x5;
  y[1] = t0 ^ x7;
  y[4] = y[1] ^ x3;
  y[12] = y[13] ^ y[14];
  y[2] = y[1] ^ x0;
  y[5] = y[1] ^ x6;
  y[3] = y[5] ^ y[8];
  const Word t1 = x4 ^ y[12];
  y[15] = t1 ^ x5;
  y[20] = t1 ^ x1;
  y[6] = y[15] ^ x7;
  y[10] = y[15] ^ t0;
  y[11] = y[20] ^ y[9];
  y[7] = x7 ^ y[11];
  y[17] = y[10] ^ y[11];
  y[19] = y[10] ^ y[8];
  y[16] = t0 ^ y[11];
  y[21] = y[13] ^ y[16];
  y[18] = x0 ^ y[16];
  return y;
}

// The inverse of the byte's image in GF(2^4), and the sums of its bits.
struct Inverse {
  Word t29, t33, t37, t40, t41, t42, t43, t44, t45;
};

constexpr Inverse inverse_of(const Forms& y) {
  const Word t2 = y[12] & y[15];
  const Word t4 = (y[3] & y[6]) ^ t2;
  const Word t6 = (y[4] & y[0]) ^ t2;
  const Word t7 = y[13] & y[16];
  const Word t9 = (y[5] & y[1]) ^ t7;
  const Word t11 = (y[2] & y[7]) ^ t7;
  const Word t12 = y[9] & y[11];
  const Word t14 = (y[14] & y[17]) ^ t12;
  const Word t16 = (y[8] & y[10]) ^ t12;
  const Word t21 = t4 ^ t14 ^ y[20];
  const Word t22 = t6 ^ t16 ^ y[19];
  const Word t23 = t9 ^ t14 ^ y[21];
  const Word t24 = t11 ^ t16 ^ y[18];
  const Word t25 = t21 ^ t22;
  const Word t26 = t21 & t23;
  const Word t27 = t24 ^ t26;
  const Word t29 = (t25 & t27) ^ t22;
  const Word t33 = ((t22 ^ t26) & (t23 ^ t24)) ^ t24;
  const Word t36 = t24 & (t27 ^ t33);
  const Word t37 = t36 ^ t23 ^ t33;
  const Word t40 = t25 ^ (t29 & (t27 ^ t36));
  const Word t41 = t40 ^ t37;
  const Word t42 = t29 ^ t33;
  return {t29, t33, t37, t40, t41, t42, t29 ^ t40, t33 ^ t37, t42 ^ t41};
}

using Products = std::array<Word, 18>;

constexpr Products products_of(const Forms& y, const Inverse& t) {
  return {t.t44 & y[15], t.t37 & y[6],  t.t33 & y[0],  t.t43 & y[16], t.t40 & y[1],  t.t29 & y[7],
          t.t42 & y[11], t.t45 & y[17], t.t41 & y[10], t.t44 & y[12], t.t37 & y[3],  t.t33 & y[4],
          t.t43 & y[13], t.t40 & y[5],  t.t29 & y[2],  t.t42 & y[9],  t.t45 & y[14], t.t41 & y[8]};
}

// The bottom linear layer.
constexpr Planes sums_of(const Products& z) {
  const Word t46 = z[15] ^ z[16];
  const Word t48 = z[5] ^ z[13];
  const Word t53 = z[0] ^ z[3];
  const Word t54 = z[6] ^ z[7];
  const Word t57 = z[2] ^ z[12] ^ t53;
  const Word t58 = z[4] ^ t46;
  const Word t59 = z[3] ^ t54;
  const Word t60 = t46 ^ t57;
  const Word t61 = z[14] ^ t57;
  const Word t62 = z[7] ^ z[8] ^ t58;
  const Word t63 = z[9] ^ z[10] ^ t58;
  const Word t64 = z[4] ^ t59;
  const Word t65 = t61 ^ t62;
  const Word t66 = z[1] ^ t63;
  const Word t67 = t64 ^ t65;
  const Word s0 = t59 ^ t63;
  const Word s3 = t53 ^ t66;
  const Word s1 = t64 ^ ~s3;
  const Word s2 = z[16] ^ z[17] ^ ~t67;
  const Word s4 = z[2] ^ z[5] ^ t66;
  const Word s5 = z[10] ^ z[11] ^ t65;
  const Word s6 = z[12] ^ t48 ^ ~t62;
  const Word s7 = t48 ^ ~t60;
  return {s7, s6, s5, s4, s3, s2, s1, s0};
}

}  // namespace

void substitute(Planes& planes) {
  const Forms forms = forms_of(planes);
  planes = sums_of(products_of(forms, inverse_of(forms)));
}

}  // namespace iog::authentication
