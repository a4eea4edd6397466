// SPDX-License-Identifier: BSD-3-Clause
#include "peer_options.h"

#include <boost/program_options.hpp>

#include <algorithm>
#include <cstdlib>
#include <locale>
#include <sstream>

namespace pcl_mrf_planes::benchmarks {

namespace po = boost::program_options;

namespace {

po::options_description describe(PeerOptions& o)
{
  po::options_description all("Options");
  auto add = all.add_options();
  add("help,h", po::bool_switch(&o.help), "print this and exit");
  add("list", po::bool_switch(&o.list), "print methods and settings and exit");
  add("data", po::value(&o.data),
      "folder of sets: SET/NAME.pcd with SET/NAME.gt.png, NAME.faces.png or "
      "NAME.pgt.png; otherwise the environment's PCL_MRF_PLANES_DATA");
  add("output", po::value(&o.output)->default_value("accuracy.csv"), "CSV to write");
  add("labels", po::value(&o.label_folder),
      "write every label image to FOLDER/METHOD.SETTING/SET/FRAME.png");
  add("sets", po::value(&o.sets)->multitoken(), "these sets only");
  add("frames", po::value(&o.frames)->multitoken(), "frames of these names only");
  add("methods", po::value(&o.methods)->multitoken(), "these methods only");
  add("try", po::value(&o.tries)->composing(),
      "METHOD:NAME=VALUE,NAME=VALUE: the method's last setting with other values, "
      "instead of the settings of --list; may be repeated");
  add("labelled-only", po::bool_switch(&o.labelled_only),
      "leave out the 640x480 clouds without ground truth, which are timed only");
  add("repeat", po::value(&o.repeat)->default_value(3),
      "runs of a method on a frame; their median time counts");
  return all;
}

double parseValue(const std::string& text)
{
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double value = 0.0;
  if (!(stream >> value) || !stream.eof())
    throw UsageError("\"" + text + "\" in --try is no number");
  return value;
}

const Peer& findPeer(const std::vector<Peer>& peers, const std::string& name)
{
  const auto found = std::find_if(peers.begin(), peers.end(),
                                  [&](const Peer& peer) { return peer.name == name; });
  if (found == peers.end())
    throw UsageError("there is no method \"" + name + "\"; see --list");
  return *found;
}

PeerRun parseTry(const std::vector<Peer>& peers, const std::string& text)
{
  const std::size_t colon = text.find(':');
  const Peer& peer = findPeer(peers, text.substr(0, colon));
  PeerRun run = {peer, peer.settings.back()};
  run.setting.description = "from the command line";
  run.setting.name = colon == std::string::npos ? "" : text.substr(colon + 1);
  std::istringstream changes(run.setting.name);
  for (std::string change; std::getline(changes, change, ',');) {
    const std::size_t equal = std::min(change.find('='), change.size());
    const auto value = run.setting.values.find(change.substr(0, equal));
    if (value == run.setting.values.end() || equal == change.size())
      throw UsageError("\"" + change + "\" in --try is no NAME=VALUE of " + peer.name +
                       "; see --list");
    value->second = parseValue(change.substr(equal + 1));
  }
  // A comma would end the column of the CSV.
  std::replace(run.setting.name.begin(), run.setting.name.end(), ',', ' ');
  return run;
}

} // namespace

PeerOptions parseOptions(int argc, const char* const argv[])
{
  PeerOptions options;
  const po::options_description all = describe(options);
  namespace style = po::command_line_style;
  try {
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv)
                  .options(all)
                  .style(style::default_style & ~style::allow_guessing)
                  .run(),
              values);
    po::notify(values);
  }
  catch (const po::error& error) {
    throw UsageError(std::string(error.what()) + "; --help lists the options");
  }
  if (options.data.empty())
    if (const char* folder = std::getenv("PCL_MRF_PLANES_DATA"))
      options.data = folder;
  if (options.data.empty() && !options.help && !options.list)
    throw UsageError("name the folder of the clouds by --data or PCL_MRF_PLANES_DATA");
  if (options.repeat < 1)
    throw UsageError("--repeat must be at least 1");
  return options;
}

std::string helpText()
{
  PeerOptions unused;
  std::ostringstream text;
  text << "benchmark_peers [options]\n\n"
          "Runs plane segmentation methods on the same organized clouds, on one core,\n"
          "and writes a CSV of times and scores, a line for each method and frame.\n\n"
       << describe(unused);
  return text.str();
}

std::vector<PeerRun> chooseRuns(const std::vector<Peer>& peers,
                                const PeerOptions& options)
{
  std::vector<PeerRun> runs;
  for (const std::string& text : options.tries)
    runs.push_back(parseTry(peers, text));
  if (!runs.empty())
    return runs;
  for (const std::string& name : options.methods)
    findPeer(peers, name);
  const auto& wanted = options.methods;
  for (const Peer& peer : peers)
    if (wanted.empty() ||
        std::find(wanted.begin(), wanted.end(), peer.name) != wanted.end())
      for (const Setting& setting : peer.settings)
        runs.push_back({peer, setting});
  return runs;
}

} // namespace pcl_mrf_planes::benchmarks
