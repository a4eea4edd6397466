// SPDX-License-Identifier: BSD-3-Clause
//
// Prints numbers for every bit of the labels, and of all results, on generated scenes: for
// scripts/compare-compilers and scripts/compare-arm to hold against each other's.
#include "reference/inputs.h"
#include "reference/result_hash.h"

#include <cstdio>
#include <string>

int main()
{
  using namespace pcl_mrf_planes;
  for (const std::string& scene : scenes::sceneNames()) {
    const OrganizedPoints points = reference::toPoints(
        reference::takePicture(scene, 320, 240, 5, scenes::SensorNoise::kinect()));
    reference::BitHash input;
    for (std::size_t i = 0; i < points.size(); ++i) {
      input.add(points.x[i]);
      input.add(points.z[i]);
    }
    std::printf("%s points %016llx\n", scene.c_str(),
                static_cast<unsigned long long>(input.value()));
    int number = 0;
    for (const Profile profile : {Profile::DEFAULT, Profile::FAST, Profile::PAPER}) {
      const auto result = segmentPlanes(points, Parameters::fromProfile(profile));
      reference::BitHash labels;
      for (const std::uint16_t label : result.labels)
        labels.add(label);
      std::printf("%s profile %d labels %016llx\n", scene.c_str(), number,
                  static_cast<unsigned long long>(labels.value()));
      std::printf("%s profile %d all %016llx\n", scene.c_str(), number++,
                  static_cast<unsigned long long>(reference::resultHash(result)));
    }
  }
}
