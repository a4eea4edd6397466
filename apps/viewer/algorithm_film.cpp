// SPDX-License-Identifier: BSD-3-Clause
#include "algorithm_film.h"

#include <pcl_mrf_planes/belief_propagation.h>
#include <pcl_mrf_planes/plane_field.h>

#include <algorithm>
#include <sstream>
#include <utility>

namespace pcl_mrf_planes::viewer {

namespace {

template <typename LabelOfTile>
std::vector<std::uint16_t> labelTiles(const ViewFrame& frame, const TileCells& cells,
                                      const LabelOfTile& label_of)
{
  std::vector<std::uint16_t> labels(frame.points.size(), 0);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto width = static_cast<std::size_t>(frame.points.width);
    const std::size_t tile =
        cells.image.tileAt(static_cast<int>(i % width), static_cast<int>(i / width));
    if (frame.points.valid[i] != 0 && cells.image.tiles[tile].kept())
      labels[i] = static_cast<std::uint16_t>(label_of(tile));
  }
  return labels;
}

void addTileSteps(const ViewFrame& frame, const TileCells& cells, AlgorithmFilm& film)
{
  const std::size_t kept = cells.image.countKept();
  film.steps.push_back(
      {"detected tiles", labelTiles(frame, cells, [](std::size_t t) { return t + 1; }),
       std::to_string(kept) + " of " + std::to_string(cells.image.tiles.size()) +
           " tiles are kept",
       -1});
  film.steps.push_back(
      {"merged planes",
       labelTiles(frame, cells,
                  [&](std::size_t t) { return cells.clusters.assignment[t] + 1; }),
       std::to_string(cells.clusters.planes.size()) + " planes", -1});
}

void addLabels(const ViewFrame& frame, const BeliefPropagation& propagation,
               const PlaneField& field, int iteration, AlgorithmFilm& film)
{
  const std::vector<std::uint16_t> labels = propagation.mapLabels();
  const double energy = field.energy(labels).total();
  film.energy.push_back(energy);
  std::ostringstream note;
  note << "energy " << static_cast<long>(energy);
  FilmStep step{"labels after " + std::to_string(iteration) +
                    (iteration == 1 ? " iteration" : " iterations"),
                std::vector<std::uint16_t>(labels.size(), 0), note.str(), iteration};
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (frame.points.valid[i] != 0)
      step.labels[i] = static_cast<std::uint16_t>(labels[i] + 1);
  film.steps.push_back(std::move(step));
}

} // namespace

AlgorithmFilm filmAlgorithm(const ViewFrame& frame, const Parameters& parameters,
                            int most_iterations)
{
  AlgorithmFilm film;
  const TileCells cells = fitTiles(frame, parameters);
  addTileSteps(frame, cells, film);
  if (cells.clusters.planes.empty())
    return film;
  std::vector<Plane> planes;
  for (const PlaneModel& model : cells.clusters.planes)
    planes.push_back(model.plane);
  const PlaneField field(frame.points, planes, parameters);
  const GridField grid = field.toGridField();
  BeliefPropagation propagation(grid, parameters.number_of_threads);
  const int iterations = std::min(parameters.iterations, most_iterations);
  for (int done = 0; done <= iterations; ++done) {
    addLabels(frame, propagation, field, done, film);
    propagation.iterate(1);
  }
  return film;
}

} // namespace pcl_mrf_planes::viewer
