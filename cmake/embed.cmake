# embed(target symbol file...): compiles files into the target as an array of {name, text}, so that the binary needs none
# of them at run time. `symbol` is declared in the target's own header as
#     extern const std::span<const EmbeddedFile> symbol;
function(embed target symbol)
    set(out ${CMAKE_CURRENT_BINARY_DIR}/${symbol}.cpp)
    list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE paths)
    add_custom_command(OUTPUT ${out}
        COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DSYMBOL=${symbol} -DROOT=${PROJECT_SOURCE_DIR}
                "-DFILES=${paths}" -P ${PROJECT_SOURCE_DIR}/cmake/embed_files.cmake
        DEPENDS ${paths} ${PROJECT_SOURCE_DIR}/cmake/embed_files.cmake VERBATIM)
    target_sources(${target} PRIVATE ${out})
    set_source_files_properties(${out} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# embed_bytes(target symbol path): the same for one file of bytes, wherever it lies, declared as
#     extern const std::span<const unsigned char> symbol;
function(embed_bytes target symbol path)
    set(out ${CMAKE_CURRENT_BINARY_DIR}/${symbol}.cpp)
    add_custom_command(OUTPUT ${out}
        COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DSYMBOL=${symbol} -DFILE=${path}
                -P ${PROJECT_SOURCE_DIR}/cmake/embed_bytes.cmake
        DEPENDS ${path} ${PROJECT_SOURCE_DIR}/cmake/embed_bytes.cmake VERBATIM)
    target_sources(${target} PRIVATE ${out})
    set_source_files_properties(${out} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
endfunction()
