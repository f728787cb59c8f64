#pragma once

namespace wishbone {

/// Of the project, such as "0.1.0".
extern const char* const kVersion;
/// Of the sources when the build was configured; "unknown" outside a checkout.
extern const char* const kGitRevision;
/// Name, version and build type.
extern const char* const kCompiler;

}  // namespace wishbone
