// Programs of other people that open our files. Tests skip when they are not there.
#pragma once

#include <cstdio>
#include <string>

namespace external {

struct Result {
    int status;
    std::string text;
};

/// Output of a shell command, standard error included.
inline Result run(const std::string& command) {
    Result result{-1, {}};
    FILE* const pipe = ::popen(("exec 2>&1\n" + command).c_str(), "r");
    if (pipe == nullptr) return result;
    char buffer[4096];
    while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, pipe)) result.text.append(buffer, count);
    result.status = ::pclose(pipe);
    return result;
}

inline bool has_assimp() { return run("assimp version").status == 0; }
inline bool has_python() { return run("/usr/bin/python3 -c 'import json, xml.dom.minidom'").status == 0; }
inline bool has_vtk() { return run("/usr/bin/python3 -c 'import vtk'").status == 0; }

/// Runs a Python program given as text.
inline Result python(const std::string& program) { return run("/usr/bin/python3 - <<'END_OF_PROGRAM'\n" + program + "\nEND_OF_PROGRAM"); }

}  // namespace external
