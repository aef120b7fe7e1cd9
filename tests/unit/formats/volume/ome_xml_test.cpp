// OME-XML: what images it describes, where their planes are, and what it may not say.
#include "formats/volume/ome_xml.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "isoatlas/error.h"

namespace isoatlas {
namespace {

OmeXml parse(const std::string& images, const std::string& own_uuid = {}) {
    return parse_ome_xml("v.ome.tif", R"(<?xml version="1.0"?><OME UUID="urn:uuid:1">)" + images + "</OME>", "v.ome.tif", own_uuid);
}

OmeImage image(const std::string& pixels, const std::string& inner = {}) {
    return parse("<Image Name=\"cells\"><Pixels DimensionOrder=\"XYZCT\" " + pixels + ">" + inner + "</Pixels></Image>").images.at(0);
}

std::string refused(const std::string& images) {
    try {
        (void)parse(images);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        return error.what();
    }
    return "";
}

TEST(OmeXml, SizesSpacingTimeAndChannels) {
    const OmeImage found = image(R"(SizeX="5" SizeY="4" SizeZ="3" SizeC="2" SizeT="7" PhysicalSizeX="0.5" PhysicalSizeXUnit="mm"
        PhysicalSizeY="500" PhysicalSizeZ="2" PhysicalSizeZUnit="cm" TimeIncrement="2" TimeIncrementUnit="min")",
                                 R"(<Channel Name="DAPI"/><Channel Name="GFP"/>)");
    EXPECT_EQ(found.name, "cells");
    EXPECT_EQ((std::array{found.width, found.height, found.slices, found.channels, found.times}),
              (std::array<std::int64_t, 5>{5, 4, 3, 2, 7}));
    EXPECT_EQ(found.unit, "mm");
    EXPECT_DOUBLE_EQ(found.spacing[0], 0.5);
    EXPECT_DOUBLE_EQ(found.spacing[1], 0.5);  // micrometres by default
    EXPECT_DOUBLE_EQ(found.spacing[2], 20);
    EXPECT_EQ(found.time_increment, 2);
    EXPECT_EQ(found.time_unit, "min");
    EXPECT_EQ(found.channel_names, (std::vector<std::string>{"DAPI", "GFP"}));
}

TEST(OmeXml, WhatIsMissingHasItsDefault) {
    const OmeImage found = image("");
    EXPECT_EQ((std::array{found.width, found.slices, found.channels, found.times, found.samples}),
              (std::array<std::int64_t, 5>{0, 1, 1, 1, 1}));
    EXPECT_EQ(found.unit, "");
    EXPECT_EQ(found.time_increment, 0);
    EXPECT_EQ(image(R"(PhysicalSizeX="-1")").spacing[0], 0);
    EXPECT_EQ(image(R"(PhysicalSizeX="nan")").spacing[0], 0);
    EXPECT_EQ(image(R"(PhysicalSizeX="2" PhysicalSizeXUnit="reference frame")").unit, "");
}

TEST(OmeXml, SamplesOfAPixelAreChannels) {
    const OmeImage colours = image(R"(SizeC="6")", R"(<Channel SamplesPerPixel="3"/><Channel SamplesPerPixel="3"/>)");
    EXPECT_EQ(colours.samples, 3);
    EXPECT_EQ(colours.plane_channels(), 2);
    EXPECT_EQ(image(R"(SizeC="4")", R"(<Channel SamplesPerPixel="3"/>)").samples, 1);  // contradictory
}

TEST(OmeXml, PlanesAreNumberedInAnyOrder) {
    for (const char* order : {"XYZCT", "XYZTC", "XYCZT", "XYCTZ", "XYTZC", "XYTCZ"}) {
        OmeImage found;
        found.order = order;
        found.slices = 3, found.channels = 4, found.times = 5;
        std::set<std::int64_t> seen;
        for (std::int64_t plane = 0; plane < found.planes(); ++plane) {
            const std::array<std::int64_t, 3> at = found.place(plane);
            EXPECT_LT(at[0], 3);
            EXPECT_LT(at[1], 4);
            EXPECT_LT(at[2], 5);
            EXPECT_EQ(found.plane(at), plane) << order;
            seen.insert(plane);
        }
        EXPECT_EQ(seen.size(), 60U);
    }
    OmeImage found;
    found.order = "XYCZT";
    found.slices = 3, found.channels = 4, found.times = 5;
    EXPECT_EQ(found.plane({1, 2, 3}), 2 + 4 * (1 + 3 * 3));
}

TEST(OmeXml, PagesOfThisFileAndOfOthers) {
    const OmeImage found = image("", R"(<TiffData/><TiffData IFD="2" FirstZ="1" FirstC="2" FirstT="3"/><TiffData IFD="5" PlaneCount="4"/>
        <TiffData><UUID FileName="other.tif">urn:uuid:2</UUID></TiffData>
        <TiffData><UUID FileName="renamed.tif">urn:uuid:1</UUID></TiffData>
        <TiffData><UUID FileName="v.ome.tif">urn:uuid:3</UUID></TiffData>)");
    ASSERT_EQ(found.pages.size(), 6U);
    EXPECT_EQ(found.pages[0].count, 0);  // all that there are
    EXPECT_EQ(found.pages[1].first, 2);
    EXPECT_EQ(found.pages[1].count, 1);
    EXPECT_EQ((std::array{found.pages[1].z, found.pages[1].channel, found.pages[1].time}), (std::array<std::int64_t, 3>{1, 2, 3}));
    EXPECT_EQ(found.pages[2].count, 4);
    EXPECT_EQ(found.pages[3].file, "other.tif");
    EXPECT_EQ(found.pages[4].file, "") << "by its UUID it is this file";
    EXPECT_EQ(found.pages[5].file, "") << "by its name it is this file";
}

TEST(OmeXml, AnotherFileMayHaveTheDescription) {
    const OmeXml found = parse(R"(<BinaryOnly MetadataFile="all.ome" UUID="urn:uuid:9"/>)");
    EXPECT_EQ(found.metadata_file, "all.ome");
    EXPECT_EQ(found.uuid, "urn:uuid:1");
    EXPECT_TRUE(found.images.empty());
}

TEST(OmeXml, PrefixesOfNamespacesDoNotMatter) {
    const std::string text = R"(<o:OME xmlns:o="x"><o:Image><o:Pixels DimensionOrder="XYZCT" SizeZ="3"/></o:Image></o:OME>)";
    EXPECT_TRUE(looks_like_ome(text));
    EXPECT_EQ(parse_ome_xml("v.tif", text, "v.tif").images.at(0).slices, 3);
    EXPECT_FALSE(looks_like_ome("ImageJ=1.53"));
    EXPECT_FALSE(looks_like_ome("<html>OME</html>"));
    EXPECT_FALSE(looks_like_ome(""));
}

TEST(OmeXml, ContradictionsAreRefused) {
    const auto pixels = [](const std::string& words) { return "<Image><Pixels DimensionOrder=\"XYZCT\" " + words + "/></Image>"; };
    EXPECT_NE(refused(pixels("SizeZ=\"0\"")).find("SizeZ"), std::string::npos);
    EXPECT_NE(refused(pixels("SizeT=\"-3\"")).find("SizeT"), std::string::npos);
    EXPECT_NE(refused(pixels("SizeC=\"1e3\"")).find("SizeC"), std::string::npos);
    EXPECT_NE(refused(pixels("SizeX=\"99999999999999999999\"")).find("SizeX"), std::string::npos);
    EXPECT_NE(refused(pixels("SizeZ=\"2000000000\" SizeT=\"2000000000\"")), "");
    EXPECT_NE(refused("<Image><Pixels DimensionOrder=\"ZYXCT\"/></Image>").find("DimensionOrder"), std::string::npos);
    EXPECT_NE(refused("<Image><Pixels DimensionOrder=\"XYZZT\"/></Image>").find("DimensionOrder"), std::string::npos);
    EXPECT_NE(refused("<Image/>").find("no image"), std::string::npos);
    EXPECT_NE(refused("<Image>"), "");
    EXPECT_NE(refused("<BinaryOnly/>").find("MetadataFile"), std::string::npos);
    EXPECT_NE(refused("<Image><Pixels DimensionOrder=\"XYZCT\"><TiffData IFD=\"-1\"/></Pixels></Image>").find("IFD"), std::string::npos);
    EXPECT_NE(refused("<Image><Pixels DimensionOrder=\"XYZCT\"><TiffData><UUID>urn:uuid:2</UUID></TiffData></Pixels></Image>")
                  .find("names no file"),
              std::string::npos);
}

TEST(OmeXml, NoPrefixEndsTheProgram) {
    const std::string whole =
        R"(<OME><Image Name="&lt;a&gt;"><Pixels DimensionOrder="XYZCT" SizeC="2"><Channel/><TiffData IFD="1"/></Pixels></Image></OME>)";
    EXPECT_EQ(parse_ome_xml("v.tif", whole, "v.tif").images.at(0).name, "<a>");
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_THROW((void)parse_ome_xml("v.tif", std::string_view(whole).substr(0, size), "v.tif"), Error) << size;
}

}  // namespace
}  // namespace isoatlas
