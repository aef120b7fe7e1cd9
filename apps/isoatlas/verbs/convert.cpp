// isoatlas convert: the samples of a volume or of a store as a volume file.
#include <fmt/format.h>

#include "data/source.h"
#include "text/document.h"
#include "text/interrupt.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {

int run_convert(const Arguments& arguments, Terminal& terminal) {
    check_output(arguments, {".nrrd", ".npy", ".raw", ".mha", ".mrc", ".vdb", ".h5", ".hdf5", ".nii", ".nii.gz", ".vti", ".tif", ".zarr"});
    Source source(arguments, terminal);
    const Volume& volume = source.volume();
    {
        const WritingGuard guard;
        write_volume(arguments.output, volume);
    }
    const auto bytes = static_cast<std::int64_t>(volume.bytes.size());
    if (arguments.json) {
        Json json = document("convert", volume.info);
        json["output"] = arguments.output;
        json["sample_bytes"] = bytes;
        print(terminal, json);
        return 0;
    }
    terminal.out() << shown_name(arguments.output) << ": " << extent_text(volume.info.extent) << ' ' << name_of(volume.info.type) << ", "
                   << bytes_text(static_cast<double>(bytes)) << " of samples\n";
    terminal.next("isoatlas info " + shell_word(arguments.output));
    return 0;
}

}  // namespace isoatlas::cli
