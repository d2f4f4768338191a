# Run when the package is put together: writes into `folder`/third-party the notices of `packages` and of the runtime library of
# `compiler`, and their versions; and RELINKING.md, with the commit of the tree `root`. Fails where a notice is missing: without
# it the program may not be passed on.
execute_process(COMMAND ${compiler} -print-file-name=libstdc++.a OUTPUT_VARIABLE runtime OUTPUT_STRIP_TRAILING_WHITESPACE)
file(REAL_PATH "${runtime}" runtime)
execute_process(COMMAND dpkg-query -S "${runtime}" OUTPUT_VARIABLE owner OUTPUT_STRIP_TRAILING_WHITESPACE)
string(REGEX REPLACE ":.*" "" owner "${owner}")
list(APPEND packages "${owner}")
file(MAKE_DIRECTORY ${folder}/third-party)
set(versions "")
foreach(package IN LISTS packages)
    set(notice /usr/share/doc/${package}/copyright)
    execute_process(COMMAND dpkg-query -W "-f=\${Package} \${Version} (source: \${source:Package} \${source:Version})\n" ${package}
        OUTPUT_VARIABLE version RESULT_VARIABLE failed)
    if(failed OR NOT EXISTS ${notice})
        message(FATAL_ERROR "${notice} is missing: the program holds a part of ${package}, whose notice must go with it. "
            "Install the package with its documentation (dpkg's path-exclude leaves it out).")
    endif()
    string(APPEND versions "${version}")
    file(READ ${notice} text)
    file(WRITE ${folder}/third-party/${package} "${text}")
endforeach()
file(WRITE ${folder}/third-party/versions "${versions}")
execute_process(COMMAND git -C ${root} describe --always --dirty OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE
    RESULT_VARIABLE no_git ERROR_QUIET)
if(no_git)
    set(commit "a tree without history")
endif()
file(READ ${root}/systemd/package/RELINKING.md text)
file(WRITE ${folder}/RELINKING.md "${text}This package was built from commit ${commit}.\n")
