# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors

# swiftlet_build_page(swiftlet_station)
#
# Builds the ground station's page with Vite and puts its files, compressed, into the library, so that the program
# serves it from anywhere and without a network. Writes <build>/generated/page_files.cpp.
function(swiftlet_build_page target)
  set(web ${PROJECT_SOURCE_DIR}/web)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${web}/src/* ${web}/public/*)
  set(generated ${PROJECT_BINARY_DIR}/generated/page_files.cpp)
  add_custom_command(
    OUTPUT ${generated}
    COMMAND ${SWIFTLET_NODE} node_modules/vite/bin/vite.js build --logLevel warn --emptyOutDir
            --outDir ${PROJECT_BINARY_DIR}/web
    COMMAND ${SWIFTLET_NODE} scripts/embed.mjs ${PROJECT_BINARY_DIR}/web ${generated}
    DEPENDS ${sources} ${web}/index.html ${web}/vite.config.ts ${web}/tsconfig.json ${web}/package-lock.json
            ${web}/scripts/embed.mjs
    WORKING_DIRECTORY ${web} COMMENT "Building the ground station's page" VERBATIM)
  set_source_files_properties(${generated} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON SKIP_LINTING ON)
  target_sources(${target} PRIVATE ${generated})
endfunction()
