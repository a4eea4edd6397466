// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "actions.h"
#include "algorithm_film.h"
#include "frame_ahead.h"
#include "parameter_sliders.h"
#include "segmented_view.h"
#include "view_settings.h"

#include <pcl_mrf_planes/io/frame.h>

#include <string>
#include <vector>

namespace pcl_mrf_planes::viewer {

/** \brief What is seen, without a window: frames, parameters, results, settings. */
class Session {
public:
  /** \brief Load the first frame and segment it.
   * \param[in] frames at least one
   * \param[in] profile name of the parameters' profile
   * \throws std::runtime_error when the first frame cannot be read */
  Session(std::vector<io::FrameSource> frames, const Parameters& parameters,
          Profile profile);

  /** \brief Do what a key does; those of the window alone (camera, picture, quit) do
   * nothing here. Problems end up in message(). */
  void perform(Action action);

  /** \brief Play on: \a seconds have passed. \return true if another frame is seen */
  bool advance(double seconds);

  /** \brief Show frame \a index, and begin to work on the one that comes next, in the
   * direction of the step, in a thread of its own. \return false with a message if it cannot be read */
  bool showFrame(std::size_t index);

  /** \brief Pick the point \a index of the cloud; -1: none. */
  void pick(long index);

  /** \brief Take other parameters and segment anew; refused with a message if they do not
   * validate. */
  void setParameters(const Parameters& parameters);
  void useSlider(std::size_t slider, double value);

  /// \name Parameter file of the keys for saving and loading
  ///@{
  void setParameterFile(const std::string& path) { parameter_file_ = path; }
  ///@}

  const ViewFrame& frame() const { return frame_; }
  const SegmentedView& main() const { return main_; }
  const SegmentedView& other() const { return other_; }
  bool compares() const { return settings.comparison != Comparison::OFF; }
  const std::vector<std::uint32_t>& mainColours() const { return main_colours_; }
  const std::vector<std::uint32_t>& otherColours() const { return other_colours_; }
  /// For the tiles, their fit error and the film; empty while none of them is seen.
  const TileCells& tiles() const { return tiles_; }
  const AlgorithmFilm& film() const { return film_; }
  const FilmStep* filmStep() const;
  const Parameters& parameters() const { return parameters_; }
  Profile profile() const { return profile_; }
  std::size_t frameIndex() const { return index_; }
  std::size_t frameCount() const { return frames_.size(); }
  bool playing() const { return playing_; }
  bool loops() const { return loop_; }
  double speed() const { return speed_; } ///< frames a second
  const std::string& message() const { return message_; }
  void say(const std::string& message) { message_ = message; }

  ViewSettings settings;

private:
  bool performView(Action action);
  bool performPlane(Action action);
  bool performSequence(Action action);
  void nextProfile();
  Choice choice() const;
  void segment();
  void colour();
  void colourOther();
  bool loadFrame(std::size_t index);
  void lookAhead(std::size_t index);
  void updateStages();
  void step(int by);
  void forgetPlanes();
  void keepPlanes(const std::vector<std::uint32_t>& before);
  std::string parameterFile() const;
  void saveParameters();
  void loadParameters();

  std::vector<io::FrameSource> frames_;
  std::size_t index_ = 0;
  ViewFrame frame_;
  Parameters parameters_;
  Profile profile_;
  SegmentedView main_;
  SegmentedView other_;
  FrameAhead ahead_;
  apps::ColourTrack track_;
  std::vector<std::uint32_t> main_colours_;
  std::vector<std::uint32_t> other_colours_;
  TileCells tiles_;
  AlgorithmFilm film_;
  bool playing_ = false;
  bool loop_ = true;
  double speed_ = 5.0;
  double waited_ = 0.0;
  std::string message_;
  std::string parameter_file_;
};

} // namespace pcl_mrf_planes::viewer
