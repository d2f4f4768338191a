# The Debian package: `cmake --build BUILD --target package` (or script/package) makes eddy_VERSION_ARCH.deb. It installs the
# program, what the system needs to know of it (systemd/), its settings and its notices, and starts the exhibit (systemd/package/).
# It takes the program as it was built last: `--target eddy` first. (By itself it would build every test.)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
set(CMAKE_SKIP_PACKAGE_ALL_DEPENDENCY ON)
set(doc share/doc/eddy)

install(TARGETS eddy RUNTIME DESTINATION bin)
install(FILES systemd/eddy.service systemd/eddy-poweroff.path systemd/eddy-poweroff.service
    DESTINATION lib/systemd/system)
install(FILES systemd/eddy.sysusers DESTINATION lib/sysusers.d RENAME eddy.conf)
install(FILES systemd/eddy.tmpfiles DESTINATION lib/tmpfiles.d RENAME eddy.conf)
install(FILES systemd/60-eddy.rules DESTINATION lib/udev/rules.d)
install(FILES README.md CHANGELOG.md systemd/package/copyright DESTINATION ${doc})
install(DIRECTORY docs DESTINATION ${doc})

# The machine's own settings: each value as the program ships it, behind a #.
set(settings ${PROJECT_BINARY_DIR}/package/exhibit.toml)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS config/exhibit.toml)
file(STRINGS config/exhibit.toml lines)
string(CONCAT text "# The settings of this exhibit. What is behind a # is what the program does when nobody says otherwise; take the # away\n"
    "# and write something else. `eddy check-config /etc/eddy/exhibit.toml` finds mistakes; files in /etc/eddy/conf.d come later and\n"
    "# win; `eddy print-config --origin` shows the result and where each value came from.\n")
set(begun OFF)
foreach(line IN LISTS lines)
    if(line MATCHES "^[a-z_0-9]+ *=")
        if(NOT begun)
            string(APPEND text "\n")
        endif()
        string(APPEND text "#${line}\n")
        set(begun ON)
    elseif(line MATCHES "^\\[" OR begun)
        string(APPEND text "${line}\n")
    endif()
endforeach()
file(CONFIGURE OUTPUT ${settings} CONTENT "${text}" @ONLY)
install(FILES ${settings} DESTINATION /etc/eddy)

# What is linked in statically, its notices and versions, as the packages that it came from have them.
set(EDDY_STATIC_PACKAGES libusb-1.0-0-dev libgpiod-dev libpng-dev zlib1g-dev libfmt-dev libtomlplusplus-dev
    nlohmann-json3-dev libcli11-dev libglm-dev libstb-dev fonts-dejavu-core)
install(CODE "set(folder \$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${doc})
set(packages ${EDDY_STATIC_PACKAGES})
set(compiler ${CMAKE_CXX_COMPILER})
set(root ${PROJECT_SOURCE_DIR})
include(${PROJECT_SOURCE_DIR}/cmake/write_notices.cmake)")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME eddy)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "Eddy maintainers <eddy@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "museum exhibit: a fluid to touch")
set(CPACK_PACKAGE_DESCRIPTION "Simulates a fluid in three dimensions on the GPU, shows it on the whole screen, and lets a hand on a
Novint Falcon feel its force. Installing it on a machine without a desktop starts the exhibit, now and at each start.")
set(CPACK_SET_DESTDIR ON) # /etc is not under the prefix
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION misc)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
# The libraries it needs are read from the program (dpkg-shlibdeps); a driver, and what the scripts call, are not in it.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libgl1-mesa-dri, systemd, udev, init-system-helpers (>= 1.51)")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "systemd-timesyncd")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/package/conffiles CONTENT "/etc/eddy/exhibit.toml\n" @ONLY)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/systemd/package/postinst ${PROJECT_SOURCE_DIR}/systemd/package/prerm
    ${PROJECT_SOURCE_DIR}/systemd/package/postrm ${PROJECT_BINARY_DIR}/package/conffiles)
include(CPack)
