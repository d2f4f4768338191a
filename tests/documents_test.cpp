#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

namespace eddy {
namespace {

namespace fs = std::filesystem;
const fs::path kRoot = EDDY_SOURCE_DIR;

std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

/// Places in the tree that a page links to, as it writes them.
std::vector<std::string> links_of(const std::string& page) {
    static const std::regex kLink(R"(\]\(([^)#]+)[^)]*\))");
    std::vector<std::string> links;
    for (std::sregex_iterator i(page.begin(), page.end(), kLink), end; i != end; ++i)
        if (const std::string link = (*i)[1]; link.find("://") == std::string::npos) links.push_back(link);
    return links;
}

TEST(Documents, LinkOnlyToWhatIsThere) {
    std::vector<fs::path> pages{kRoot / "README.md", kRoot / "CHANGELOG.md"};
    for (const auto& entry : fs::directory_iterator(kRoot / "docs"))
        if (entry.path().extension() == ".md") pages.push_back(entry.path());
    std::size_t links = 0;
    for (const fs::path& page : pages)
        for (const std::string& link : links_of(text_of(page))) {
            EXPECT_TRUE(fs::exists(page.parent_path() / link)) << page << " links to " << link;
            ++links;
        }
    EXPECT_GT(links, 10u);  // or this looks for the wrong thing
}

TEST(Documents, PicturesAreAllShownSomewhere) {
    std::string pages = text_of(kRoot / "README.md");
    for (const auto& entry : fs::directory_iterator(kRoot / "docs"))
        if (entry.path().extension() == ".md") pages += text_of(entry.path());
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / "docs"))
        if (entry.path().extension() == ".png") {
            EXPECT_NE(pages.find(entry.path().filename().string()), std::string::npos) << entry.path();
        }
}

/// tests/stability/mutations takes the text out of the file; what it does not find, or finds twice, proves nothing.
TEST(Documents, EveryGuardThatIsTakenOutInTurnIsThereOnce) {
    std::istringstream list(text_of(kRoot / "tests/stability/mutations.list"));
    int guards = 0;
    for (std::string line; std::getline(list, line);) {
        if (line.empty() || line.front() == '#') continue;
        std::istringstream fields(line);
        std::string name, file, guard;
        std::getline(std::getline(std::getline(fields, name, '\t'), file, '\t'), guard, '\t');
        const std::string text = text_of(kRoot / file);
        const std::size_t at = text.find(guard);
        ASSERT_NE(at, std::string::npos) << name << ": not in " << file;
        EXPECT_EQ(text.find(guard, at + 1), std::string::npos) << name << ": more than once in " << file;
        ++guards;
    }
    EXPECT_GT(guards, 40);  // or this looks for the wrong thing
}

}  // namespace
}  // namespace eddy
