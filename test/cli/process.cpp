// SPDX-License-Identifier: BSD-3-Clause
#include "process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h> // environ, too: g++ and clang++ define _GNU_SOURCE

#include <fstream>
#include <sstream>

namespace pcl_mrf_planes::test {

namespace {

std::string content(const std::string& path)
{
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::vector<char*> pointers(std::vector<std::string>& words)
{
  std::vector<char*> result;
  for (std::string& word : words)
    result.push_back(word.data());
  result.push_back(nullptr);
  return result;
}

std::vector<std::string>
variables(const std::vector<std::pair<std::string, std::string>>& set)
{
  std::vector<std::string> result;
  for (const auto& variable : set)
    result.push_back(variable.first + '=' + variable.second);
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string entry = *variable;
    bool replaced = false;
    for (const auto& other : set)
      replaced =
          replaced || entry.compare(0, other.first.size() + 1, other.first + '=') == 0;
    if (!replaced)
      result.push_back(entry);
  }
  return result;
}

} // namespace

Outcome runProcess(const std::string& program,
                   const std::vector<std::string>& arguments,
                   const std::string& scratch,
                   const std::vector<std::pair<std::string, std::string>>& environment)
{
  const std::string out = scratch + "/process.out";
  const std::string err = scratch + "/process.err";
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  const int flags = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out.c_str(), flags, 0600);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err.c_str(), flags, 0600);

  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> settings = variables(environment);
  Outcome outcome;
  pid_t child = 0;
  const int failure = posix_spawn(&child, program.c_str(), &files, nullptr,
                                  pointers(words).data(), pointers(settings).data());
  posix_spawn_file_actions_destroy(&files);
  int status = 0;
  if (failure != 0 || waitpid(child, &status, 0) != child)
    return outcome;
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.out = content(out);
  outcome.err = content(err);
  return outcome;
}

} // namespace pcl_mrf_planes::test
