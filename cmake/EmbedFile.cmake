# cmake -DIN=FILE -DOUT=FILE.cpp -DSYMBOL=NAME -DNAMESPACE=NAME -P EmbedFile.cmake: the file's bytes as an array, because
# a string literal would be at the mercy of quotes and of the compiler's limits.
file(READ ${IN} hex HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${hex}")
file(WRITE ${OUT}
"#include <string_view>
namespace {
constexpr char bytes[] = {${bytes}};
}
namespace candela::${NAMESPACE} {
extern const std::string_view ${SYMBOL};
const std::string_view ${SYMBOL}{bytes, sizeof(bytes)};
}
")
