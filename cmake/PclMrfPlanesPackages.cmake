# Debian packages by CPack: the library, what programs are built with, and the apps.
# They are made by packaging/check-deb; the preset "package" sets what they need.
set(soversion "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
set(library_package "libpcl-mrf-planes${soversion}")
set(development_package "libpcl-mrf-planes-dev")
set(tools_package "pcl-mrf-planes-tools")
set(revision 1)
set(full_version "${PROJECT_VERSION}-${revision}")

# Papers of a package: copyright, changelog, what lintian may find and why.
function(pcl_mrf_planes_debian_papers component package)
  set(folder "${PROJECT_SOURCE_DIR}/packaging/debian")
  set(made "${CMAKE_CURRENT_BINARY_DIR}/debian/${component}")
  configure_file("${folder}/changelog.in" "${made}/changelog.Debian" @ONLY)
  file(COPY_FILE "${PROJECT_SOURCE_DIR}/CHANGELOG.md" "${made}/changelog")
  execute_process(COMMAND gzip -9nf "${made}/changelog.Debian" "${made}/changelog"
    COMMAND_ERROR_IS_FATAL ANY)
  install(FILES "${made}/changelog.Debian.gz" "${made}/changelog.gz"
                "${folder}/copyright"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${package}" COMPONENT ${component})
  configure_file("${folder}/lintian-overrides.in" "${made}/overrides" @ONLY)
  install(FILES "${made}/overrides" RENAME "${package}"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/lintian/overrides" COMPONENT ${component})
endfunction()

if(PCL_MRF_PLANES_DEBIAN)
  pcl_mrf_planes_debian_papers(library ${library_package})
  pcl_mrf_planes_debian_papers(development ${development_package})
  pcl_mrf_planes_debian_papers(tools ${tools_package})
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME pcl-mrf-planes)
set(CPACK_PACKAGE_VENDOR "pcl_mrf_planes developers")
set(CPACK_PACKAGE_CONTACT "pcl_mrf_planes developers <developers@pcl-mrf-planes.org>")
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL library development tools)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${revision})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS
  "${CMAKE_CURRENT_BINARY_DIR}/src" "${CMAKE_CURRENT_BINARY_DIR}/io")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${library_package})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA
  "${PROJECT_SOURCE_DIR}/packaging/debian/triggers")
set(CPACK_POST_BUILD_SCRIPTS
  "${PROJECT_SOURCE_DIR}/packaging/debian/finish_packages.cmake")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
"plane segmentation of organized point clouds - libraries
Finds planes in organized point clouds of depth cameras and lidars, and labels
every point with one of them, or none, by inference on a Markov random field.
It works in the place of the organized plane segmentation of the Point Cloud
Library (PCL), and needs neither normals nor colours.
.
This package contains the shared libraries: the segmentation, and readers of
clouds, depth images and data sets.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME ${development_package})
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "${library_package} (= ${full_version}), libpcl-dev (>= ${PCL_MRF_PLANES_PCL_VERSION}), libeigen3-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"plane segmentation of organized point clouds - development files
Finds planes in organized point clouds of depth cameras and lidars, and labels
every point with one of them, or none, by inference on a Markov random field.
.
This package contains the headers, the CMake package and the pkg-config files.")

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME ${tools_package})
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS "${library_package} (= ${full_version})")
set(CPACK_COMPONENT_TOOLS_DESCRIPTION
"plane segmentation of organized point clouds - command-line tools
Finds planes in organized point clouds of depth cameras and lidars, and labels
every point with one of them, or none, by inference on a Markov random field.
.
This package contains programs that segment clouds, depth images and whole
data sets, show what they found in a viewer, generate scenes with ground truth,
and score results.")

include(CPack)
