#include "formats/volume/tiff_file.h"

#include <algorithm>
#include <utility>

#include "base/check.h"
#include "formats/common/read_ahead.h"
#include "formats/volume/imagej_labels.h"
#include "formats/volume/tiff_handle.h"

namespace isoatlas {
namespace {

constexpr std::uint16_t kMaxReducedImages = 32;
constexpr std::uint32_t kImagejCounts = 50838, kImagejTexts = 50839;

template <class T>
std::span<const T> private_array(TIFF* tiff, std::uint32_t tag, std::size_t entry_bytes) {
    std::uint32_t count = 0;
    const void* data = nullptr;
    const TIFFField* field = TIFFFindField(tiff, tag, TIFF_ANY);
    if (field == nullptr || TIFFFieldPassCount(field) == 0 || TIFFFieldReadCount(field) != TIFF_VARIABLE2) return {};
    if (static_cast<std::size_t>(TIFFFieldSetGetSize(field)) != entry_bytes) return {};
    if (TIFFGetField(tiff, tag, &count, &data) != 1 || data == nullptr) return {};
    return {static_cast<const T*>(data), count};
}

}  // namespace

TiffFile::Handle::Handle(const std::string& path, bool may_skip_rest)
    : client{.path = path, .file = with_read_ahead(open_file(path)), .messages = {}}, where("header"), skip_rest(may_skip_rest) {
    tiff = open_tiff_client(client);
    if (tiff == nullptr) corrupt("header", "cannot be read as TIFF");
    current = TIFFCurrentDirOffset(tiff);
    prepare();
}

TiffFile::Handle::~Handle() {
    if (tiff != nullptr) TIFFClose(tiff);
}

void TiffFile::Handle::corrupt(const std::string& place, const std::string& what) const {
    const std::string text = client.messages.empty() ? what : what + ": " + client.messages;
    throw Error(ErrorKind::input,
                {.file = client.path, .where = place, .what = text, .next = "the file is damaged or incomplete: copy or export it again"});
}

void TiffFile::Handle::unsupported(const std::string& what, const std::string& expected, const std::string& next) const {
    throw Error(ErrorKind::unsupported, {.file = client.path, .where = where, .what = what, .expected = expected, .next = next});
}

/// Colours of JPEG are decoded to RGB.
void TiffFile::Handle::prepare() {
    if (tag<std::uint16_t>(TIFFTAG_COMPRESSION, COMPRESSION_NONE) == COMPRESSION_JPEG &&
        tag<std::uint16_t>(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK) == PHOTOMETRIC_YCBCR)
        TIFFSetField(tiff, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
}

void TiffFile::Handle::list_pages() {
    chain.clear();
    const std::uint64_t first = TIFFCurrentDirOffset(tiff);
    ISOATLAS_CHECK(first == current && TIFFCurrentDirectory(tiff) == 0);
    do {
        prepare();
        current = TIFFCurrentDirOffset(tiff);
        where = "page " + std::to_string(chain.size());
        list_page();
        client.messages.clear();
    } while (TIFFReadDirectory(tiff) == 1);
    // A valid end of the chain of directories has no message and no link.
    if (!client.messages.empty() || TIFFLastDirectory(tiff) == 0)
        corrupt("page " + std::to_string(chain.size()), "its directory cannot be read");
}

void TiffFile::Handle::list_page() {
    constexpr std::uint32_t kPreview = FILETYPE_REDUCEDIMAGE | FILETYPE_MASK;
    client.messages.clear();
    const std::vector<TiffEntry> entries = directory_entries();
    TiffPage page;
    try {
        page = describe_page();
        check_entries(entries);
        check_page(page);
    } catch (const Error& error) {
        page.problem = std::make_shared<const Error>(error);
    }
    page.directory = current;
    page.number = static_cast<std::int64_t>(chain.size());
    page.is_preview = (tag<std::uint32_t>(TIFFTAG_SUBFILETYPE, 0) & kPreview) != 0;
    if (chain.empty() && !tags) read_tags();
    chain.push_back(std::move(page));
}

void TiffFile::Handle::read_tags() {
    tags.emplace();
    const char* text = nullptr;
    if (TIFFGetField(tiff, TIFFTAG_IMAGEDESCRIPTION, &text) == 1 && text != nullptr) tags->description = text;
    float x = 0, y = 0;
    if (TIFFGetField(tiff, TIFFTAG_XRESOLUTION, &x) == 1) tags->x_resolution = static_cast<double>(x);
    if (TIFFGetField(tiff, TIFFTAG_YRESOLUTION, &y) == 1) tags->y_resolution = static_cast<double>(y);
    tags->resolution_unit = tag<std::uint16_t>(TIFFTAG_RESOLUTIONUNIT, RESUNIT_INCH);
    tags->photometric = tag<std::uint16_t>(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    tags->labels = imagej_labels(private_array<std::uint32_t>(tiff, kImagejCounts, sizeof(std::uint32_t)),
                                 private_array<std::byte>(tiff, kImagejTexts, 1), TIFFIsBigEndian(tiff) != 0);
}

void TiffFile::Handle::load(std::uint64_t directory, const std::string& name) {
    client.messages.clear();
    where = name;
    if (directory == current) return;
    current = 0;
    if (TIFFSetSubDirectory(tiff, directory) != 1) corrupt(name, "its directory cannot be read");
    current = directory;
    prepare();
}

std::vector<std::uint64_t> TiffFile::Handle::reduced_images() const {
    std::uint16_t count = 0;
    const std::uint64_t* offsets = nullptr;
    if (TIFFGetField(tiff, TIFFTAG_SUBIFD, &count, &offsets) != 1 || offsets == nullptr) return {};
    return {offsets, offsets + std::min(count, kMaxReducedImages)};
}

std::string TiffPage::shape() const {
    const std::string several = pixel.samples > 1 ? ", " + std::to_string(pixel.samples) + " values per pixel" : "";
    return std::to_string(width) + " x " + std::to_string(height) + " " + name_of(type) + several;
}

TiffFile::TiffFile(const std::string& path, bool skip_rest) : handle_(std::make_unique<Handle>(path, skip_rest)) {}
TiffFile::~TiffFile() = default;
TiffFile::TiffFile(TiffFile&&) noexcept = default;
TiffFile& TiffFile::operator=(TiffFile&&) noexcept = default;

const std::string& TiffFile::path() const { return handle_->client.path; }
bool TiffFile::big_endian() const { return TIFFIsBigEndian(handle_->tiff) != 0; }
std::int64_t TiffFile::bytes() const { return handle_->client.file->size(); }
bool TiffFile::is_big_tiff() const { return TIFFIsBigTIFF(handle_->tiff) != 0; }

const std::vector<TiffPage>& TiffFile::chain() {
    if (handle_->chain.empty()) handle_->list_pages();
    return handle_->chain;
}

std::vector<TiffPage> TiffFile::pages() {
    std::vector<TiffPage> pages;
    for (const TiffPage& page : chain()) {
        if (page.is_preview && page.number > 0) continue;
        if (page.problem) throw Error(*page.problem);
        pages.push_back(page);
    }
    return pages;
}

const TiffTags& TiffFile::tags() {
    static_cast<void>(chain());
    return *handle_->tags;
}

TiffPage TiffFile::page_at(std::uint64_t directory, std::int64_t number, std::int64_t level, bool is_checked) {
    const std::string name = "page " + std::to_string(number);
    handle_->load(directory, name);
    if (level > 0) {
        const std::vector<std::uint64_t> reduced = handle_->reduced_images();
        if (level > std::ssize(reduced)) handle_->corrupt(name, "has no reduced image of level " + std::to_string(level));
        handle_->load(reduced[static_cast<std::size_t>(level - 1)], name + ", level " + std::to_string(level));
    }
    TiffPage page = handle_->describe_page();
    page.number = number;
    if (is_checked) {
        handle_->check_entries(handle_->directory_entries());
        handle_->check_page(page);
        if (level > 0 && handle_->is_cut_off()) handle_->corrupt(handle_->where, "the file ends before its pixels do");
    }
    return page;
}

std::string TiffFile::encoding(int compression) {
    if (compression == COMPRESSION_NONE) return "raw";
    const TIFFCodec* codec = TIFFFindCODEC(static_cast<std::uint16_t>(compression));
    return codec == nullptr ? "compression " + std::to_string(compression) : codec->name;
}

void TiffFile::read_raw(std::int64_t offset, std::span<std::byte> out) { read_fully(*handle_->client.file, path(), offset, out); }

}  // namespace isoatlas
