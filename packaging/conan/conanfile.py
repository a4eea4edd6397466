# SPDX-License-Identifier: BSD-3-Clause
"""Recipe for Conan 2: conan create packaging/conan. Libraries only. It was never run by Conan
itself, which Debian does not have; see packaging/README.md for what is tested."""
import os

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class PclMrfPlanes(ConanFile):
    name = "pcl_mrf_planes"
    version = "0.1.0"
    description = "Plane segmentation of organized point clouds by a Markov random field"
    license = "BSD-3-Clause"
    package_type = "library"
    settings = "os", "compiler", "build_type", "arch"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": True, "fPIC": True}

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..")
        for pattern in ("CMakeLists.txt", "LICENSE", "CHANGELOG.md", "cmake/*", "include/*",
                        "io/*", "packaging/*", "src/*"):
            copy(self, pattern, root, self.export_sources_folder)

    def requirements(self):
        self.requires("eigen/3.4.0", transitive_headers=True)
        self.requires("pcl/1.13.1", transitive_headers=True, transitive_libs=True)
        self.requires("boost/1.83.0")
        self.requires("hdf5/1.14.3")
        self.requires("highway/1.1.0")
        self.requires("onetbb/2021.12.0")
        self.requires("libpng/1.6.43")
        self.requires("yaml-cpp/0.8.0")

    def configure(self):
        if self.options.shared:
            self.options.rm_safe("fPIC")

    def layout(self):
        cmake_layout(self)

    def generate(self):
        dependencies = CMakeDeps(self)
        # Named as Highway's own CMake package names itself.
        dependencies.set_property("highway", "cmake_file_name", "hwy")
        dependencies.set_property("highway", "cmake_target_name", "hwy::hwy")
        dependencies.generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["PCL_MRF_PLANES_APPS"] = False
        toolchain.cache_variables["PCL_MRF_PLANES_TESTS"] = False
        # Variables of PCL's and CMake's own files, which those of Conan do not set.
        toolchain.cache_variables["PCL_COMMON_LIBRARIES"] = "PCL::common"
        toolchain.cache_variables["PCL_IO_LIBRARIES"] = "PCL::io"
        toolchain.cache_variables["HDF5_C_LIBRARIES"] = "hdf5::hdf5"
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "pcl_mrf_planes")
        core = self.cpp_info.components["core"]
        core.libs = ["pcl_mrf_planes"]
        core.set_property("cmake_target_name", "pcl_mrf_planes::pcl_mrf_planes")
        core.requires = ["eigen::eigen", "pcl::common", "highway::highway", "onetbb::onetbb",
                         "boost::headers"]
        readers = self.cpp_info.components["io"]
        readers.libs = ["pcl_mrf_planes_io"]
        readers.set_property("cmake_target_name", "pcl_mrf_planes::pcl_mrf_planes_io")
        readers.requires = ["core", "pcl::io", "hdf5::hdf5", "libpng::libpng",
                            "yaml-cpp::yaml-cpp"]
