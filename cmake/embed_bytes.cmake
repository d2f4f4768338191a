# Run by embed_bytes(): writes ${OUT}, a C++ file with the bytes of ${FILE}.
file(READ ${FILE} bytes HEX)
string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
file(WRITE ${OUT} "#include <span>\n\nnamespace eddy {\nextern const std::span<const unsigned char> ${SYMBOL};\n"
    "namespace {\nconst unsigned char kBytes[] = {\n${bytes}\n};\n}  // namespace\n"
    "const std::span<const unsigned char> ${SYMBOL}{kBytes};\n}  // namespace eddy\n")
