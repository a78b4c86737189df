// Views of OpenColorIO 2's configurations. Part of the plug-in ramify-ocio.so.
#include <OpenColorIO/OpenColorIO.h>

#include <strings.h>

#include <cstring>
#include <new>
#include <sstream>
#include <string>
#include <vector>

extern "C" {
#include "image/ocio.h"
}

namespace OCIO = OCIO_NAMESPACE;

namespace
{

using Names = std::vector<std::string>;

// Runs body and converts exceptions to an Error.
template <typename Body> bool guarded(const OcioParams *params, Error *e, Body body)
{
    try {
        return body();
    } catch (const std::bad_alloc &) {
        return error_set(e, ERROR_MEMORY, "'%s': out of memory", params->config);
    } catch (const std::exception &failure) {
        error_set(e, ERROR_INPUT, "OpenColorIO cannot use '%s': %s", params->config,
                  failure.what());
    } catch (...) {
        error_set(e, ERROR_INPUT, "OpenColorIO cannot use '%s'", params->config);
    }
    return error_key(e, "config");
}

bool is_among(const std::string &name, const Names &names)
{
    for (const std::string &other : names) {
        if (strcasecmp(name.c_str(), other.c_str()) == 0) {
            return true;
        }
    }
    return false;
}

// what: "display"; of: "of display 'sRGB' " or "".
bool unknown(const char *key, const std::string &name, const std::string &of, const Names &names,
             Error *e)
{
    std::string list;
    for (const std::string &other : names) {
        list += (list.empty() ? "" : ", ") + other;
    }
    error_set(e, ERROR_INPUT, "'%s' is no %s %sof the configuration; it has %s", name.c_str(), key,
              of.c_str(), list.empty() ? "none" : list.c_str());
    return error_key(e, "%s", key);
}

Names displays_of(const OCIO::Config &config)
{
    Names names;
    for (int i = 0; i < config.getNumDisplays(); i++) {
        names.push_back(config.getDisplay(i));
    }
    return names;
}

Names views_of(const OCIO::Config &config, const char *display)
{
    Names names;
    for (int i = 0; i < config.getNumViews(display); i++) {
        names.push_back(config.getView(display, i));
    }
    return names;
}

Names looks_of(const OCIO::Config &config)
{
    Names names;
    for (int i = 0; i < config.getNumLooks(); i++) {
        names.push_back(config.getLookNameByIndex(i));
    }
    return names;
}

Names spaces_of(const OCIO::Config &config)
{
    Names names;
    for (int i = 0; i < config.getNumColorSpaces(); i++) {
        names.push_back(config.getColorSpaceNameByIndex(i));
    }
    return names;
}

// The looks of "a, +b, -c", without their signs; "a | b" tries b where a cannot be made.
Names names_in(const std::string &looks)
{
    Names names;
    std::string name;
    for (char c : looks + ",") {
        bool ends = c == ',' || c == ':' || c == '|';
        if (!ends && !(name.empty() && std::strchr(" \t+-", c))) {
            name += c;
        } else if (ends && !name.empty()) {
            names.push_back(name.substr(0, name.find_last_not_of(" \t") + 1));
            name.clear();
        }
    }
    return names;
}

// The configuration's names are not told apart by case.
bool check_names(const OCIO::Config &config, const OcioParams *params, const char *display,
                 Error *e)
{
    if (params->display && !is_among(display, displays_of(config))) {
        return unknown("display", display, "", displays_of(config), e);
    }
    if (params->view && !is_among(params->view, views_of(config, display))) {
        return unknown("view", params->view, "of display '" + std::string(display) + "' ",
                       views_of(config, display), e);
    }
    if (params->look) {
        for (const std::string &name : names_in(params->look)) {
            if (!is_among(name, looks_of(config))) {
                return unknown("look", name, "", looks_of(config), e);
            }
        }
    }
    if (params->space && !config.getColorSpace(params->space)) {
        return unknown("space", params->space, "", spaces_of(config), e);
    }
    return true;
}

// The colour space of linear Rec. 709 by the names it has in common configurations.
const char *find_rec709(const OCIO::Config &config)
{
    static const char *const names[] = {"lin_rec709_srgb",
                                        "lin_rec709",
                                        "Linear Rec.709 (sRGB)",
                                        "Linear Rec.709",
                                        "lin_srgb",
                                        "Utility - Linear - sRGB",
                                        "Utility - Linear - Rec.709"};
    for (const char *name : names) {
        if (config.getColorSpace(name)) {
            return name;
        }
    }
    return nullptr;
}

// Rec. 709 to ACES2065-1, adapted from D65 to ACES's white by Bradford's method.
OCIO::ConstTransformRcPtr aces_of_rec709()
{
    OCIO::MatrixTransformRcPtr matrix = OCIO::MatrixTransform::Create();
    const double m[16] = {0.439632981919,
                          0.382988698152,
                          0.177378319929,
                          0,
                          0.089776442959,
                          0.813439428749,
                          0.096784128292,
                          0,
                          0.017541170383,
                          0.111546553302,
                          0.870912276314,
                          0,
                          0,
                          0,
                          0,
                          1};
    matrix->setMatrix(m);
    return matrix;
}

// Appends what leads from Rec. 709 to the color space that the view starts from, and returns it.
const char *begin_at(const OCIO::Config &config, const OcioParams *params,
                     OCIO::GroupTransformRcPtr &group)
{
    if (params->space) {
        return params->space;
    }
    if (const char *rec709 = find_rec709(config)) {
        return rec709;
    }
    if (config.hasRole("aces_interchange")) {
        group->appendTransform(
            OCIO_DYNAMIC_POINTER_CAST<OCIO::Transform>(aces_of_rec709()->createEditableCopy()));
        return "aces_interchange";
    }
    return OCIO::ROLE_SCENE_LINEAR;
}

OCIO::ConstCPUProcessorRcPtr make_view(const OCIO::Config &config, const OcioParams *params,
                                       const char *display)
{
    OCIO::GroupTransformRcPtr first = OCIO::GroupTransform::Create();
    OCIO::DisplayViewTransformRcPtr view = OCIO::DisplayViewTransform::Create();
    view->setSrc(begin_at(config, params, first));
    view->setDisplay(display);
    view->setView(params->view ? params->view : config.getDefaultView(display));
    OCIO::LegacyViewingPipelineRcPtr pipeline = OCIO::LegacyViewingPipeline::Create();
    pipeline->setDisplayViewTransform(view);
    if (params->look) {
        pipeline->setLooksOverrideEnabled(true);
        pipeline->setLooksOverride(params->look);
    }
    OCIO::ConstConfigRcPtr own = config.createEditableCopy();
    OCIO::GroupTransformRcPtr whole = OCIO::GroupTransform::Create();
    whole->appendTransform(first);
    whole->appendTransform(pipeline->getProcessor(own)->createGroupTransform());
    return own->getProcessor(whole)->getDefaultCPUProcessor();
}

OCIO::ConstConfigRcPtr open_config(const char *name)
{
    if (OCIO_VERSION_HEX < 0x02020000 && std::strncmp(name, "ocio://", 7) == 0) {
        throw OCIO::Exception("built-in configurations need OpenColorIO 2.2 or newer, and this "
                              "is " OCIO_VERSION_STR "; a file would do");
    }
    return OCIO::Config::CreateFromFile(name);
}

// NULL with e if a name is wrong; throws what OpenColorIO throws.
OCIO::ConstCPUProcessorRcPtr open_view(const OcioParams *params, Error *e)
{
    OCIO::SetLoggingLevel(OCIO::LOGGING_LEVEL_NONE); // it would print
    OCIO::ConstConfigRcPtr config = open_config(params->config);
    const char *display = params->display ? params->display : config->getDefaultDisplay();
    if (!check_names(*config, params, display, e)) {
        return nullptr;
    }
    return make_view(*config, params, display);
}

bool check(const OcioParams *params, Error *e)
{
    return guarded(params, e, [&] { return open_view(params, e) != nullptr; });
}

bool apply(const OcioParams *params, Image *image, Error *e)
{
    return guarded(params, e, [&] {
        OCIO::ConstCPUProcessorRcPtr view = open_view(params, e);
        if (view) {
            OCIO::PackedImageDesc pixels(image->pixel, image->width, image->height,
                                         image->channels);
            view->apply(pixels);
        }
        return view != nullptr;
    });
}

} // namespace

extern "C" {
extern const OcioPlugin views_ocio;
const OcioPlugin views_ocio = {sizeof(OcioPlugin), check, apply};
}
