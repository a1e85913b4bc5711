#include "candela/measure/stroke_font.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace candela::measure {
namespace {

/// Digits in pairs are x (0 to 4) and y (0 the top of capitals, 6 the baseline, 8 the lowest descender); a
/// blank lifts the pen. From '!' to '~'.
constexpr std::array<const char*, 94> kGlyphs{"0004 06",
                                              "0002 2022",
                                              "1016 3036 0242 0444",
                                              "413010010213334445361605 2026",
                                              "4006 0010110100 3545463635",
                                              "4612112031320405162644",
                                              "0002",
                                              "20020527",
                                              "00222507",
                                              "2125 0244 0442",
                                              "2125 0343",
                                              "151607",
                                              "0333",
                                              "06",
                                              "4006",
                                              "103041453616050110",
                                              "012026",
                                              "01103041420646",
                                              "004022324345361605",
                                              "36300444",
                                              "400002324345361605",
                                              "3010020516364544331304",
                                              "004016",
                                              "103041423313020110 1304051636454433",
                                              "4233130201103041443616",
                                              "02 06",
                                              "12 151607",
                                              "310335",
                                              "0242 0444",
                                              "013305",
                                              "01103041422324 26",
                                              "34321214444130100105161646",
                                              "062046 1434",
                                              "0030414233030600 3344453606",
                                              "4130100105163645",
                                              "00204244260600",
                                              "40000646 0333",
                                              "400006 0333",
                                              "4130100105163645434323",
                                              "0006 4046 0343",
                                              "0006",
                                              "3035261605",
                                              "0006 400346",
                                              "000646",
                                              "0600234046",
                                              "06004640",
                                              "103041453616050110",
                                              "06003041423303",
                                              "103041453616050110 2446",
                                              "06003041423303 2346",
                                              "413010010213334445361605",
                                              "0040 2026",
                                              "000516364540",
                                              "002640",
                                              "0016223640",
                                              "0046 4006",
                                              "002340 2326",
                                              "00400646",
                                              "20000727",
                                              "0046",
                                              "00202707",
                                              "022042",
                                              "0747",
                                              "0011",
                                              "12223336 341405162635",
                                              "0006 0312223335261605",
                                              "321203051636",
                                              "3036 3322120305162635",
                                              "043433221203051636",
                                              "30201116 0232",
                                              "32372808 3322120305162635",
                                              "0006 0312223336",
                                              "0206 00",
                                              "121708 10",
                                              "0006 320436",
                                              "000516",
                                              "0602 03122326 23324346",
                                              "0206 0312223336",
                                              "122233352616050312",
                                              "0208 0312223335261605",
                                              "3238 3322120305162635",
                                              "0206 031232",
                                              "3212031424352606",
                                              "10152636 0232",
                                              "0205162635 3236",
                                              "022642",
                                              "0216233642",
                                              "0236 3206",
                                              "0226 42261808",
                                              "02320636",
                                              "20111203141627",
                                              "0007",
                                              "00111223141607",
                                              "03123443"};

struct Extra {
    std::uint32_t code;
    const char* glyph;
};
constexpr Extra kExtras[] = {{0xb0, "0110211201"}, {0xb2, "0010110222"},   {0xb7, "03"},
                             {0xd7, "0245 4205"},  {0x3b3, "022542 2528"}, {0x2013, "0343"},
                             {0x2014, "0343"},     {0x2212, "0343"}};

/// Letters of Latin-1 from 0xc0 on without their accents.
constexpr const char* kPlain = "AAAAAAACEEEEIIIIDNOOOOOxOUUUUYPsaaaaaaaceeeeiiiidnooooo/ouuuuypy";

const char* glyph_of(std::uint32_t code) {
    if (code == ' ' || code == 0xa0) return "";
    if (code > ' ' && code < 0x7f) return kGlyphs[code - '!'];
    for (const Extra& extra : kExtras) {
        if (extra.code == code) return extra.glyph;
    }
    if (code >= 0xc0 && code <= 0xff) return kGlyphs[std::size_t(kPlain[code - 0xc0]) - '!'];
    return kGlyphs['?' - '!'];
}

/// The next character; a broken sequence is a question mark.
std::uint32_t next_code(std::string_view& text) {
    const auto first = static_cast<unsigned char>(text.front());
    text.remove_prefix(1);
    if (first < 0x80) return first;
    std::uint32_t code = first >= 0xf0 ? first & 0x07u : first >= 0xe0 ? first & 0x0fu : first & 0x1fu;
    for (int more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : 1; more > 0; --more) {
        if (text.empty() || (static_cast<unsigned char>(text.front()) & 0xc0) != 0x80) return '?';
        code = code << 6 | (static_cast<unsigned char>(text.front()) & 0x3fu);
        text.remove_prefix(1);
    }
    return code;
}

}  // namespace

StrokedText stroked(std::string_view utf8) {
    constexpr double blank = 3.0, between = 1.8;
    StrokedText out;
    while (!utf8.empty()) {
        std::string_view glyph = glyph_of(next_code(utf8));
        double right = glyph.empty() ? blank - between : 0.0;
        bool lifted = true;
        while (!glyph.empty()) {
            if (glyph.front() == ' ') {
                lifted = true;
                glyph.remove_prefix(1);
                continue;
            }
            const double x = glyph[0] - '0', y = glyph[1] - '0';
            glyph.remove_prefix(2);
            if (lifted) out.lines.emplace_back();
            lifted = false;
            out.lines.back().emplace_back(out.width + x, y - kStrokeCapHeight);
            right = std::max(right, x);
        }
        out.width += right + between;
    }
    out.width = std::max(0.0, out.width - between);
    return out;
}

}  // namespace candela::measure
