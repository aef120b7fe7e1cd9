// Animations as video files, encoded by ffmpeg if it is installed.
#pragma once

#include <string>

#include <isoatlas/isoatlas.h>

namespace isoatlas::cli {

/// Throws Error{unsupported} with a next step when the output is a .mp4 and there is no ffmpeg.
void check_movie(const std::string& output);

/// Writes .mp4 by ffmpeg, everything else by write_animation(). Throws Error{resource} when ffmpeg fails.
void write_movie(const std::string& output, const Animation& animation);

}  // namespace isoatlas::cli
