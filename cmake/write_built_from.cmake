# Run at each build: writes ${OUT}, a C++ file with what `git describe` says of the tree ${ROOT}, if that is another than the file
# says already; of a tree that is no checkout, ${VERSION}.
set(from "")
if(EXISTS ${ROOT}/.git)
    execute_process(COMMAND git -C ${ROOT} describe --always --dirty
        OUTPUT_VARIABLE from OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(from STREQUAL "")
    set(from ${VERSION})
endif()
set(text "#include \"firmware/built_from.h\"\n\nnamespace eddy {\nconst std::string_view kBuiltFrom = \"${from}\";\n}  // namespace eddy\n")
set(before "")
if(EXISTS ${OUT})
    file(READ ${OUT} before)
endif()
if(NOT text STREQUAL before)
    file(WRITE ${OUT} "${text}")
endif()
