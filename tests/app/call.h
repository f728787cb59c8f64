#pragma once

#include <stdio.h>
#include <sys/wait.h>

#include <string>

namespace wishbone {

struct Answer {
  int code = -1;
  std::string text;  ///< standard output and error
};

/// Runs the command as a user does. `before` is what the shell does first, in the process of the command.
inline Answer call(const std::string& arguments, const std::string& before = ":") {
  const std::string line =
      "{ " + before + "; } && exec " + std::string(WISHBONE_COMMAND) + " " + arguments + " 2>&1";
  FILE* pipe = popen(line.c_str(), "r");
  Answer answer;
  char buffer[4096];
  while (const std::size_t n = fread(buffer, 1, sizeof buffer, pipe)) answer.text.append(buffer, n);
  const int status = pclose(pipe);
  if (WIFEXITED(status)) answer.code = WEXITSTATUS(status);
  return answer;
}

}  // namespace wishbone
