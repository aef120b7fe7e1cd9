#include "data/several.h"

#include <algorithm>

#include <fmt/format.h>

#include "data/input.h"

namespace isoatlas::cli {
namespace {

/// The first one, where an option leaves it open.
OpenOptions completed(OpenOptions open, const Channels& channels) {
    if (!open.channel && channels.names.size() > 1) open.channel = "0";
    if (!open.time_step && channels.time_steps > 1) open.time_step = 0;
    return open;
}

void choose_store(Arguments& arguments) {
    Several several;
    several.arguments = arguments;
    several.collection = read_collection(arguments.file);
    several.channels = several.collection->channels;
    const bool takes_first = arguments.verb == "view" || arguments.verb == "info";
    several.first = choose_volume(*several.collection, takes_first ? completed(arguments.open, several.channels) : arguments.open);
    arguments = of_volume(several, several.first);
    if (takes_first) arguments.several = std::make_shared<const Several>(std::move(several));
}

void choose_volume_of_file(Arguments& arguments) {
    Several several;
    several.arguments = arguments;
    Arguments own = arguments;
    std::vector<std::string> notes;
    try {
        const FileVolumes volumes = open_first(own, notes)->info().volumes;
        several.channels = channels_of(volumes);
        several.first = volumes.channel + volumes.time_step * std::ssize(several.channels.names);
    } catch (const Error& error) {
        if (error.kind() == ErrorKind::cancelled) throw;
        return;  // the verb reports it
    }
    if (several.channels.count() == 1) return;
    if (!arguments.open.channel && own.open.channel) own.open.channel = channel_word(several.channels, several.first);
    arguments.open = own.open;
    arguments.several = std::make_shared<const Several>(std::move(several));
}

}  // namespace

std::string channel_word(const Channels& channels, std::int64_t volume) {
    const std::int64_t channel = channels.channel_of(volume);
    const std::string& name = channels.names[static_cast<std::size_t>(channel)];
    return !name.empty() && std::ranges::count(channels.names, name) == 1 ? name : std::to_string(channel);
}

std::string volume_text(const Channels& channels, std::int64_t volume) {
    std::string text;
    if (channels.names.size() > 1) text = "channel " + channel_word(channels, volume);
    if (channels.time_steps > 1) text += fmt::format("{}time step {}", text.empty() ? "" : ", ", channels.time_step_of(volume));
    return text;
}

Arguments of_volume(const Several& several, std::int64_t volume) {
    Arguments own = several.arguments;
    if (several.collection) {
        own.file = several.collection->path_of(volume);
        own.open.channel.reset(), own.open.time_step.reset();
        return own;
    }
    if (several.channels.names.size() > 1) own.open.channel = channel_word(several.channels, volume);
    if (several.channels.time_steps > 1) own.open.time_step = several.channels.time_step_of(volume);
    return own;
}

std::unique_ptr<VolumeReader> open_first(Arguments& arguments, std::vector<std::string>& notes) {
    for (;;) {
        try {
            return open_input(arguments).reader;
        } catch (const Error& error) {
            if (error.reason() == Reason::channel_needed && !arguments.open.channel) {
                arguments.open.channel = "0";
                notes.emplace_back("this is the first channel; --channel chooses another one");
            } else if (error.reason() == Reason::time_step_needed && !arguments.open.time_step) {
                arguments.open.time_step = 0;
                notes.emplace_back("this is the first time step; --time-step chooses another one");
            } else {
                throw;
            }
        }
    }
}

void choose_one(Arguments& arguments) {
    if (arguments.verb == "serve" || arguments.file.empty()) return;
    if (is_collection(arguments.file))
        choose_store(arguments);
    else if (arguments.verb == "view" && !is_atlas(arguments.file))
        choose_volume_of_file(arguments);
}

}  // namespace isoatlas::cli
