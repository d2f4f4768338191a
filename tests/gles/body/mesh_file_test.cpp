#include "gles/body/mesh_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <functional>

#include "gles/body/distance_grid.h"
#include "tests/gles/body/sample_meshes.h"
#include "tests/gles/body/shape_reference.h"

namespace eddy::gles {
namespace {

std::string refusal(const std::function<void()>& f) {
    try {
        f();
    } catch (const MeshError& e) {
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
        return e.what();
    }
    return "";
}
std::string stl_refusal(const std::string& bytes) {
    return refusal([&] { parse_stl(bytes, "rock.stl", 1.0); });
}
std::string obj_refusal(const std::string& text) {
    return refusal([&] { parse_obj(text, "rock.obj", 1.0); });
}
#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << text

/// A tetrahedron, outward.
const std::string kObj =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST(MeshFile, IsTheSameInEveryFormat) {
    const TriangleMesh ball = icosphere(0.5, 2, {0.1, 0.2, 0.3});
    const MassProperties mass = mass_properties(ball);
    for (const TriangleMesh& read : {parse_stl(binary_stl(ball), "", 2.0), parse_stl(text_stl(ball), "", 2.0),
                                     parse_obj(obj(ball), "", 2.0)}) {
        EXPECT_EQ(read.corners.size(), ball.corners.size()) << "corners of neighbours are one";
        EXPECT_EQ(read.triangles.size(), ball.triangles.size());
        EXPECT_NEAR(mass_properties(read).volume_m3, 8.0 * mass.volume_m3, 1e-6);
        EXPECT_LT(glm::length(mass_properties(read).centre_m - 2.0 * mass.centre_m), 1e-6);
    }
}

TEST(MeshFile, MayBeABinaryOneThatBeginsWithSolid) {
    std::string bytes = binary_stl(icosphere(1.0, 1));
    bytes.replace(0, 5, "solid");
    EXPECT_EQ(parse_stl(bytes, "", 1.0).triangles.size(), 80u);
}

TEST(MeshFile, MayNameVerticesInEveryFormOfObj) {
    const double sixth = 1.0 / 6.0;
    EXPECT_NEAR(mass_properties(parse_obj(kObj, "", 1.0)).volume_m3, sixth, 1e-12);
    const std::string forms =
        "# rock\r\nmtllib a.mtl\r\nv 0 0 0 1.0\r\nv +1.0e0 0 0\r\nv 0 1 0 0.5 0.5 0.5\r\nvt 0 0\r\nvn 0 0 "
        "1\r\n"
        "v 0 0 1\r\n\r\nusemtl a\r\nf 1/1 3/1 2/1 # floor\r\nf 1//1 2//1 4//1\r\nf 1/1/1 4/1/1 3/1/1\r\nf -3 "
        "-2 -1";
    EXPECT_NEAR(mass_properties(parse_obj(forms, "", 1.0)).volume_m3, sixth, 1e-12);
    const std::string polygons =
        "v 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\nv 0 0 4\nv 2 0 4\nv 2 3 4\nv 0 3 4\n"
        "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    EXPECT_NEAR(mass_properties(parse_obj(polygons, "", 1.0)).volume_m3, 24.0, 1e-12);
}

TEST(MeshFile, ThatIsInsideOutIsTurned) {
    TriangleMesh ball = icosphere(1.0, 2);
    for (glm::uvec3& t : ball.triangles) std::swap(t.x, t.y);
    EXPECT_GT(mass_properties(parse_stl(binary_stl(ball), "", 1.0)).volume_m3, 4.0);
}

TEST(MeshFile, MayHaveTrianglesWithoutArea) {
    EXPECT_EQ(parse_obj(kObj + "f 1 1 2\nf 3 3 3\n", "", 1.0).triangles.size(), 4u);
    // A side that ends in the middle of another's edge, closed by a triangle of no height.
    const std::string t_joint = parse_obj(
                                    "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nv 1 0 0\n"
                                    "f 1 3 2\nf 1 5 4\nf 5 2 4\nf 1 2 5\nf 1 4 3\nf 2 3 4\n",
                                    "", 1.0)
                                            .triangles.size() == 6
                                    ? ""
                                    : "dropped";
    EXPECT_EQ(t_joint, "");
}

TEST(MeshFile, ThatIsNotClosedSaysWhere) {
    const std::string open = obj_refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
    EXPECT_SAYS(open, "rock.obj:5: the surface is not closed");
    EXPECT_SAYS(open, "belongs to 1 triangle, not 2 (3 edges are like that)");
    EXPECT_SAYS(open, "close holes");
    EXPECT_SAYS(obj_refusal(kObj + "v 1 1 1\nf 1 2 5\nf 2 1 5\n"), "belongs to 4 triangles, not 2");
    EXPECT_SAYS(obj_refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 4 3\n"),
                "have opposite outsides (3 edges are like that): make the normals consistent");
    std::string bytes = binary_stl(icosphere(1.0, 1));
    bytes[80] = 79;
    EXPECT_SAYS(stl_refusal(bytes), "rock.stl: byte ");
    EXPECT_SAYS(stl_refusal(bytes), "not closed");
    EXPECT_SAYS(obj_refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n"), "encloses no volume");
}

TEST(MeshFile, ThatIsEmptyOrCutShortSaysSo) {
    EXPECT_SAYS(stl_refusal(""), "0 bytes are too few");
    EXPECT_SAYS(obj_refusal(""), "rock.obj: no triangles in it");
    EXPECT_SAYS(stl_refusal("solid a\nendsolid a\n"), "no triangles in it");
    EXPECT_SAYS(obj_refusal("v 0 0 0\nf 1 1 1\n"), "two corners at the same place");
    const std::string bytes = binary_stl(icosphere(1.0, 1));
    EXPECT_SAYS(stl_refusal(bytes.substr(0, 1000)),
                "rock.stl: byte 80: 80 triangles are announced, but the file holds 18");
    const std::string text = text_stl(icosphere(1.0, 0));
    EXPECT_SAYS(stl_refusal(text.substr(0, text.find("endfacet"))), "the file ends before 'endsolid'");
}

TEST(MeshFile, WithNumbersThatAreNoPlacesSaysWhichLine) {
    EXPECT_SAYS(obj_refusal("v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n"),
                "rock.obj:4: a coordinate is not a finite");
    EXPECT_SAYS(obj_refusal("v 0 0 0\nv 1 1e999 0\n"), "rock.obj:2: '1e999' is not a number");
    EXPECT_SAYS(obj_refusal("v 0 0 0\nv 1 1,5 0\n"), "rock.obj:2: '1,5' is not a number");
    EXPECT_SAYS(obj_refusal("v 0 0\n"), "rock.obj:1: 'v' needs three numbers, not 2");
    EXPECT_SAYS(obj_refusal("v 0 0 0\nv 1e9 0 0\nv 0 1 0\nf 1 2 3\n"),
                "1e+09 m is out of reach: is the scale");
    EXPECT_SAYS(refusal([] { parse_obj(kObj, "rock.obj", 1e-12); }), "is no size: is the scale of 1e-12 m");
    EXPECT_SAYS(obj_refusal(kObj + "f 1 2 5\n"), "rock.obj:9: vertex 5 of 4 above this line");
    EXPECT_SAYS(obj_refusal(kObj + "f 0 1 2\n"), "rock.obj:9: vertex 0 of 4");
    EXPECT_SAYS(obj_refusal(kObj + "f a/1 2 3\n"), "rock.obj:9: 'a/1' is not the number of a vertex");
    EXPECT_SAYS(obj_refusal(kObj + "f 1 2\n"), "rock.obj:9: a face of 2 vertices");
    EXPECT_SAYS(stl_refusal("solid\nfacet\nvertex 0 0 0\nendfacet\n"),
                "rock.stl:4: the facet that ends here has 1 corners");
    EXPECT_SAYS(stl_refusal("solid\nvertex 0 0 0\n"), "rock.stl:2: a vertex outside a facet");
    EXPECT_SAYS(stl_refusal("solid\nfacet\nfacet\n"), "rock.stl:3: a facet begins inside another");
    EXPECT_SAYS(stl_refusal("solid\nwhat\x01 is this\n"), "rock.stl:2: 'what?' is no word of an STL file");
}

TEST(MeshFile, ThatIsNotThereOrOfAnotherKindSaysSo) {
    EXPECT_SAYS(refusal([] { read_mesh("no/such.stl", 1.0); }), "no/such.stl: cannot be read: No such file");
    EXPECT_SAYS(refusal([] { read_mesh("rock.ply", 1.0); }),
                "rock.ply: a mesh is a file that ends in .stl or .obj");
    const std::string path = testing::TempDir() + "eddy_rock.OBJ";
    std::ofstream(path) << kObj;
    EXPECT_EQ(read_mesh(path, 1.0).triangles.size(), 4u);
    std::remove(path.c_str());
    EXPECT_SAYS(refusal([] { read_mesh(testing::TempDir() + "/.stl", 1.0); }), "cannot be read");
}

/// Whatever the bytes: a mesh from which a distance grid can be made, or a MeshError.
void digest(const std::string& bytes, int& meshes) {
    for (const auto& parse : {parse_stl, parse_obj}) try {
            const DistanceGrid grid(parse(bytes, "fuzz", 1.0), 8);
            EXPECT_TRUE(std::isfinite(grid.at(glm::dvec3(0.1))));
            ++meshes;
        } catch (const MeshError& e) {
            EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
        }
}

TEST(MeshFile, OfAnyBytesIsAMeshOrRefused) {
    Random random(9);
    const auto upto = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    const TriangleMesh ball = icosphere(1.0, 1);
    const std::string valid[] = {binary_stl(ball), text_stl(icosphere(1.0, 0)), obj(ball), kObj};
    const char* words[] = {
        "nan", "-1", "0", "1e308", "-1e-308", "f 1 2 3\n", "facet ", "vertex 1 2 3\n", "\0\0", "99999999999"};
    int meshes = 0;
    for (int i = 0; i < 2000; ++i) {
        std::string bytes(upto(400), '\0');
        for (char& c : bytes) c = static_cast<char>(random());
        if (i % 4 == 1) bytes.insert(0, "solid ");
        digest(bytes, meshes);
        std::string mutated = valid[upto(4)];
        if (i % 5 == 0) mutated.resize(upto(mutated.size()));
        for (std::size_t k = upto(4); k-- > 0 && !mutated.empty();) {
            const std::size_t at = upto(mutated.size());
            if (random() % 2)
                mutated[at] = static_cast<char>(random());
            else
                mutated.replace(at, upto(6), words[upto(10)]);
        }
        digest(mutated, meshes);
    }
    EXPECT_GT(meshes, 100);  // of 8000: damage that does not show in the shape's closedness
}

}  // namespace
}  // namespace eddy::gles
