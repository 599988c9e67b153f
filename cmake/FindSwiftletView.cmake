# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors

# What the ground station is built with: Boost.Beast for its server, Node.js and npm for its page, and the page's
# packages, which `npm ci` fetches once, as web/package-lock.json names and hashes them.
find_package(Boost 1.74 QUIET)
find_program(SWIFTLET_NODE node)
find_program(SWIFTLET_NPM npm)
mark_as_advanced(SWIFTLET_NODE SWIFTLET_NPM)

set(SwiftletView_FOUND FALSE)
if(NOT Boost_FOUND)
  message(STATUS "view: Boost 1.74 or newer is missing (libboost-dev)")
elseif(NOT SWIFTLET_NODE OR NOT SWIFTLET_NPM)
  message(STATUS "view: Node.js or npm is missing (nodejs, npm)")
else()
  file(SHA256 ${PROJECT_SOURCE_DIR}/web/package-lock.json lock)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/web/package-lock.json)
  set(stamp ${PROJECT_SOURCE_DIR}/web/node_modules/.swiftlet-${lock})
  set(fetched 0)
  if(NOT EXISTS ${stamp})
    message(STATUS "view: fetching the page's packages with npm")
    execute_process(COMMAND ${SWIFTLET_NPM} ci --ignore-scripts --no-audit --no-fund
                    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}/web RESULT_VARIABLE fetched
                    OUTPUT_VARIABLE said ERROR_VARIABLE said)
    if(fetched EQUAL 0)
      file(TOUCH ${stamp})
    else()
      message(STATUS "view: npm could not fetch the page's packages:\n${said}")
    endif()
  endif()
  if(fetched EQUAL 0)
    set(SwiftletView_FOUND TRUE)
  endif()
endif()
