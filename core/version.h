#pragma once

namespace wishbone {

extern const char* const kVersion;      ///< of the project, "0.1.0"
extern const char* const kGitRevision;  ///< of the sources when the build was configured; "unknown" outside a checkout
extern const char* const kCompiler;     ///< name, version and build type

}  // namespace wishbone
