# Targets `format`, `format-check` and `tidy`, over the project's own sources.
file(GLOB_RECURSE sources CONFIGURE_DEPENDS
    ${PROJECT_SOURCE_DIR}/config/*.cpp ${PROJECT_SOURCE_DIR}/config/*.h ${PROJECT_SOURCE_DIR}/hal/*.cpp
    ${PROJECT_SOURCE_DIR}/hal/*.h ${PROJECT_SOURCE_DIR}/gles/*.cpp ${PROJECT_SOURCE_DIR}/gles/*.h
    ${PROJECT_SOURCE_DIR}/firmware/*.cpp ${PROJECT_SOURCE_DIR}/firmware/*.h ${PROJECT_SOURCE_DIR}/tests/*.cpp
    ${PROJECT_SOURCE_DIR}/tests/*.h)
set(translation_units ${sources})
list(FILTER translation_units INCLUDE REGEX "\\.cpp$")

find_program(CLANG_FORMAT clang-format)
find_program(CLANG_TIDY clang-tidy)
if(CLANG_FORMAT)
    add_custom_target(format COMMAND ${CLANG_FORMAT} -i ${sources} VERBATIM)
    add_custom_target(format-check COMMAND ${CLANG_FORMAT} --dry-run -Werror ${sources} VERBATIM)
endif()
if(CLANG_TIDY)
    add_custom_target(tidy COMMAND ${CLANG_TIDY} --quiet -p ${PROJECT_BINARY_DIR} ${translation_units} VERBATIM)
endif()
