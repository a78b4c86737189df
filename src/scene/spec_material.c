// Keys of materials.
#include "land/where.h"
#include "objects/common/tables.h"
#include "render/material/material.h"
#include "render/material/thin_film.h"
#include "scene/builtin.h"
#include "scene/spec_check.h"

#include <string.h>

#define BIT(kind) (1u << (kind))
#define ALL_BUT(kinds) (~(kinds))
#define FILM BIT(MATERIAL_THIN_FILM)
#define GAS BIT(MATERIAL_PLASMA)
#define COLOURED ALL_BUT(BIT(MATERIAL_EMISSION) | GAS)
#define CLEAR (BIT(MATERIAL_DIELECTRIC) | BIT(MATERIAL_WATER))
#define PATTERNED ALL_BUT(BIT(MATERIAL_EMISSION) | CLEAR | FILM | GAS)
#define LAYERED (BIT(MATERIAL_DIFFUSE) | BIT(MATERIAL_PRINCIPLED))
#define BUMPED (PATTERNED | CLEAR)

#define KIND(NAME, name) {#name, MATERIAL_##NAME},
static const EnumName KINDS[] = {MATERIAL_KINDS(KIND){0}};
#undef KIND
static const EnumName PATTERNS[] = {{"none", PATTERN_NONE},
                                    {"bark", PATTERN_BARK},
                                    {"ground", PATTERN_GROUND},
                                    {"stone", PATTERN_STONE},
                                    {"masonry", PATTERN_MASONRY},
                                    {"dressed", PATTERN_DRESSED},
                                    {"leaf", PATTERN_LEAF},
                                    {"noise", PATTERN_NOISE},
                                    {"corallite", PATTERN_CORALLITE},
                                    {"reef", PATTERN_REEF},
                                    {"brain", PATTERN_BRAIN},
                                    {"youth", PATTERN_YOUTH},
                                    {"sand", PATTERN_SAND},
                                    {"mountain", PATTERN_MOUNTAIN},
                                    {"badlands", PATTERN_BADLANDS},
                                    {"water", PATTERN_WATER},
                                    {"altitude", PATTERN_ALTITUDE},
                                    {"strata", PATTERN_STRATA},
                                    {"alps", PATTERN_ALPS},
                                    {"volcano", PATTERN_VOLCANO},
                                    {"dunes", PATTERN_DUNES},
                                    {"hills", PATTERN_HILLS},
                                    {"coast", PATTERN_COAST},
                                    {"braided", PATTERN_BRAIDED},
                                    {"glacial", PATTERN_GLACIAL},
                                    {"karst", PATTERN_KARST},
                                    {"mud", PATTERN_MUD},
                                    {"floodplain", PATTERN_FLOODPLAIN},
                                    {"river", PATTERN_RIVER},
                                    {"delta", PATTERN_DELTA},
                                    {"silt", PATTERN_SILT},
                                    {"heath", PATTERN_HEATH},
                                    {"ice", PATTERN_ICE},
                                    {"snow", PATTERN_SNOW},
                                    {"rubble", PATTERN_RUBBLE},
                                    {"wood", PATTERN_WOOD},
                                    {0}};

static const EnumName BARKS[] = {{"furrowed", BARK_FURROWED},
                                 {"plates", BARK_PLATES},
                                 {"birch", BARK_BIRCH},
                                 {"smooth", BARK_SMOOTH},
                                 {"fibrous", BARK_FIBROUS},
                                 {"flakes", BARK_FLAKES},
                                 {"bands", BARK_BANDS},
                                 {"scales", BARK_SCALES},
                                 {"canes", BARK_CANES},
                                 {"gnarled", BARK_GNARLED},
                                 {0}};

static const EnumName DISPLACEMENTS[] = {
    {"auto", DISPLACEMENT_AUTO}, {"off", DISPLACEMENT_OFF}, {"on", DISPLACEMENT_ON}, {0}};

static const EnumName MAPPINGS[] = {
    {"auto", MAPPING_AUTO}, {"uv", MAPPING_UV}, {"triplanar", MAPPING_TRIPLANAR}, {0}};

static const Key LAYER_KEYS[] = {
    {KEY_OF(MaterialLayer, material, "material", KEY_TEXT), .flags = KEY_REQUIRED,
     .doc = "Name of the layer's material: diffuse or principled, without layers of its own."},
    {KEY_OF(MaterialLayer, where, "where", KEY_LIST),
     .count_offset = offsetof(MaterialLayer, where_count), .count = 16, .table = &map_range_table,
     .doc = "Conditions on maps of the object's surface seen from above, which all hold where the "
            "layer lies; none = everywhere."},
    {KEY_OF(MaterialLayer, strength, "strength", KEY_FLOAT), .high = 1,
     .doc = "Share of the surface that the layer covers where they hold."},
    {KEY_OF(MaterialLayer, fray, "fray", KEY_FLOAT), .high = 1e5, .unit = "m",
     .doc = "Distance over which noise displaces the layer's borders, so that they are ragged."},
    {0},
};

static void layer_defaults(void *out)
{
    *(MaterialLayer *)out = (MaterialLayer){.strength = 1.0f};
}

static const Table LAYER_TABLE = {
    .name = "layer",
    .doc = "Another material on a material, where maps of the surface allow it. Colour, bumps, "
           "roughness and coat are mixed; relief, opacity and exports stay those of the material "
           "below. Curves have no layers.",
    .example = "materials:\n"
               "  - {name: turf, pattern: ground}\n"
               "  - {name: silt, color: [0.20, 0.16, 0.11]}\n"
               "  - name: slopes\n"
               "    pattern: stone\n"
               "    layers:\n"
               "      - {material: turf, fray: 2, where: [{map: slope, range: [0, 24], fade: 8}]}\n"
               "      - {material: silt, where: [{map: wetness, range: [9, 30], fade: 1}]}\n"
               "objects:\n"
               "  - name: hills\n"
               "    material: slopes\n"
               "    terrain: {size: 400, resolution: 256}\n",
    .size = sizeof(MaterialLayer),
    .keys = LAYER_KEYS,
    .defaults = layer_defaults};

static const Key MATERIAL_KEYS[] = {
    {KEY_OF(Material, name, "name", KEY_NAME), .flags = KEY_REQUIRED, .count = 64,
     .doc = "Name that objects refer to. With the name of a built-in material, the entry changes "
            "that material and starts from its values. Other names have no slash, so that a later "
            "version's built-in materials, whose names have one, are never yours."},
    {KEY_OF(Material, kind, "kind", KEY_ENUM), .names = KINDS,
     .doc = "diffuse: matt; conductor: metal; dielectric: glass or ice; water: open water, whose "
            "body and "
            "bed sun and sky light straight through the surface; principled: matt base "
            "under a glossy coat, or metal; leaf: thin sheet that transmits light; emission: emits "
            "light, closed meshes and curves outward, sheets to both sides; thin_film: clear soap "
            "film with interference colours; plasma: glowing gas with soft edges, which hides "
            "nothing behind it."},
    {KEY_OF(Material, color, "color", KEY_COLOR), .kinds = COLOURED, .high = 1,
     .doc = "Reflectance; of a leaf, that of the upper side; of a dielectric, the tint of "
            "transmitted light."},
    {KEY_OF(Material, color2, "color2", KEY_COLOR), .kinds = PATTERNED | BIT(MATERIAL_WATER) | GAS,
     .high = 1,
     .doc = "Second colour of the pattern: furrows, soil, veins; of water its foam; of plasma the "
            "factor on its radiance where a branch ends, toward which it changes with the time of "
            "growth."},
    {KEY_OF(Material, transmittance, "transmittance", KEY_COLOR), .kinds = BIT(MATERIAL_LEAF),
     .high = 1, .doc = "Colour of the light that a leaf transmits."},
    {KEY_OF(Material, autumn_color, "autumn_color", KEY_COLOR), .kinds = BIT(MATERIAL_LEAF),
     .high = 1,
     .doc = "Reflectance of a leaf that has turned (leaves.autumn); its transmittance follows."},
    {KEY_OF(Material, young_color, "young_color", KEY_COLOR), .kinds = BIT(MATERIAL_LEAF),
     .high = 1,
     .doc = "Reflectance of a leaf just out of its bud (leaves.flush, leaves.emergence), reddish "
            "of many plants; its transmittance follows. Black = paler than the full-grown leaf."},
    {KEY_OF(Material, underside_color, "underside_color", KEY_COLOR), .kinds = BIT(MATERIAL_LEAF),
     .high = 1,
     .doc = "Reflectance of a leaf's lower side: reddish of water lilies, nearly white of white "
            "poplar. Black = paler and greyer than the upper side."},
    {KEY_OF(Material, faded_color, "faded_color", KEY_COLOR), .kinds = BIT(MATERIAL_LEAF),
     .high = 1,
     .doc = "Reflectance of a leaf's tissue that has lost its green (venation.autumn and spots), "
            "yellow of most plants; its transmittance follows. Black = a yellow of its own green."},
    {KEY_OF(Material, absorption, "absorption", KEY_COLOR), .kinds = CLEAR, .high = 1e6,
     .unit = "1/m", .doc = "Absorption coefficient of the interior (Beer-Lambert law)."},
    {KEY_OF(Material, scattering, "scattering", KEY_COLOR), .kinds = CLEAR, .high = 1e6,
     .unit = "1/m", .doc = "Scattering coefficient of the interior, as for milk, flesh or ice."},
    {KEY_OF(Material, anisotropy, "anisotropy", KEY_FLOAT), .kinds = CLEAR, .low = -0.98,
     .high = 0.98,
     .doc = "Mean cosine of the scattering angle: 0 = isotropic, near 1 = forward, as in flesh."},
    {KEY_OF(Material, roughness, "roughness", KEY_FLOAT), .kinds = (COLOURED & ~FILM) | GAS,
     .high = 1,
     .doc = "Roughness of the surface: 0 = a mirror or a clear pane, 1 = matt; of plasma the "
            "softness of its edge: 0 = as of gas that glows evenly, 1 = it fades from a narrow "
            "core on."},
    {KEY_OF(Material, metallic, "metallic", KEY_FLOAT), .kinds = BIT(MATERIAL_PRINCIPLED),
     .high = 1, .doc = "Metalness: 0 = dielectric, 1 = metal."},
    {KEY_OF(Material, specular, "specular", KEY_FLOAT),
     .kinds = BIT(MATERIAL_PRINCIPLED) | BIT(MATERIAL_LEAF), .high = 1,
     .doc = "Strength of the glossy coat; 0.5 = index of refraction 1.5."},
    {KEY_OF(Material, ior, "ior", KEY_FLOAT), .kinds = CLEAR | FILM, .low = 1, .high = 5,
     .doc = "Index of refraction; 1 = index-matched: light passes straight through."},
    {KEY_OF(Material, radiance, "radiance", KEY_COLOR), .kinds = BIT(MATERIAL_EMISSION) | GAS,
     .high = 1e12, .unit = "W/(m^2 sr)",
     .doc = "Emitted radiance; of plasma where it is seen through its middle, from its side."},
    {KEY_OF(Material, film_thickness, "film_thickness", KEY_FLOAT), .kinds = FILM,
     .high = (double)THIN_FILM_MOST_NM, .unit = "nm",
     .doc = "Thickness of the film where it is vertical; 0 = invisible."},
    {KEY_OF(Material, film_drainage, "film_drainage", KEY_FLOAT), .kinds = FILM, .high = 1,
     .doc = "How much thinner the film is where it faces up, and thicker where it faces down."},
    {KEY_OF(Material, film_swirl, "film_swirl", KEY_FLOAT), .kinds = FILM, .high = 1,
     .doc = "Variation of the thickness in streaks, about pattern_scale wide."},
    {KEY_OF(Material, pattern, "pattern", KEY_ENUM), .kinds = BUMPED, .names = PATTERNS,
     .doc =
         "Procedural pattern of color and color2, with bumps. bark: ridges and furrows; ground: "
         "soil and grass in patches; stone: broken faces, joints, minerals and stains; masonry: "
         "a wall of weathered stones in courses as high as pattern_scale; dressed: the same stone "
         "without joints, for arches, sills and fallen blocks; rubble: a wall of "
         "rough stones of all sizes, about pattern_scale high, in mortar; leaf: "
         "veins and blotches; noise: plain noise; corallite: "
         "cups of a coral; brain: winding ridges of a brain coral, color2 in the valleys; "
         "reef: a boulder of coral that lives: cups, swellings paler (color2) above, bites of fish "
         "(scars), dead patches under turf (moss) and pink coralline algae (lichen), darker "
         "undersides; of dead rock with moss and lichen 1; youth: "
         "color2 where a branch still grows, with a fine grain of pattern_scale; sand: ripples "
         "of a sea "
         "floor; mountain: rock in blocks between beds and joints (with a terrain's beds in their "
         "colours relative to their mean), scree, grass and snow; "
         "badlands: soft beds, a terrain's or bands of the colours about pattern_scale thick, with "
         "ragged, sharp contacts, laminae, ledges, tongues of washed-down mud, crumbs of clay and "
         "runnels, and washes of pale silt and gravel; water: ripples; "
         "altitude: a map's scale of colours over a terrain; strata: the colours of a "
         "terrain's beds, with rubble, soil (color) and shrubs (color2); hills: dry grasses in "
         "patches, fresh grass and scrub (color2) in hollows, bunches, rills, paths of cattle; "
         "coast: cliffs of a terrain's beds, a "
         "dark wet band with weed and barnacles over a tide of pattern_scale metres, lichens "
         "above, turf (color) on top, sand (color2) below; dunes: sand with ripples "
         "of pattern_scale across the wind, and gravel (color2) where there is little; karst: grey "
         "limestone with dark streaks of water, bushes (color) and fields (color2); mud: a pond's "
         "bed, darker (color2) with depth; floodplain: a meandering river's bars of sand (color), "
         "meadows (color2) on its scrolls, reeds in hollows, fields on old ground; river: its "
         "water, through which the bed (color2) shows where it is shallow; delta: mud (color), "
         "reeds and marsh (color2), "
         "willows on levees and meadows of a river's delta; silt: its water, from the clear sea "
         "(color) to the river's mud (color2), with the bed in shoals; heath: open slopes of "
         "mountains: dry and lush grass (color), bushes, stones, and worn tracks of soil (color2) "
         "down steep ground, in patches of pattern_scale; ice: new ice, best of kind principled, "
         "dark and glossy (color), dull with haze in patches of pattern_scale and dusted with "
         "grains of rime (color2); snow: settled snow in hummocks of pattern_scale, with ripples "
         "of "
         "the wind in places, pits and crumbs of what fell from trees, and tracks of a fox "
         "(scars); wood: weathered wood with its fibres along the object's y axis: silver-grey "
         "(color), dark between the fibres (color2), with knots, rings on the ends, and the checks "
         "that a shape's checks open; none: one colour."},
    {KEY_OF(Material, bark, "bark", KEY_ENUM), .kinds = PATTERNED, .names = BARKS,
     .doc = "Pattern bark: its kind. furrowed: long ridges between deep furrows, as of oak, lime "
            "and ash, on thick branches; with a pattern_scale below 0.02, as of a miniature tree, "
            "on thinner ones, too; plates: long thick plates that flake in layers, on thinner "
            "stems thin flakes of "
            "color2, as of "
            "pine; birch: white, with dark lenticels across, peeling, and black (color2) diamonds; "
            "smooth: a skin with faint wrinkles and scars, as of beech; fibrous: long strips, as "
            "of cypress; flakes: patches of several ages from color, the freshest, to color2, as "
            "of plane and eucalyptus; bands: glossy with corky bands (color2) across, as of "
            "cherry; scales: thin scales in layers, redder (color2) where one came off, as of "
            "spruce; canes: smooth, with rings at nodes and bloom (color2) below them, as of "
            "bamboo; gnarled: plates of several sizes that break into small ones, fissured and "
            "weathered to grey, with stretches of smooth young bark, as of old olives and apples."},
    {KEY_OF(Material, colors, "colors", KEY_LIST), .kinds = PATTERNED,
     .count_offset = offsetof(Material, color_count), .count = 64, .table = &color_stop_table,
     .doc = "Pattern altitude: its colours by altitude, linear between these; none = from color to "
            "color2."},
    {KEY_OF(Material, layers, "layers", KEY_LIST), .kinds = LAYERED,
     .count_offset = offsetof(Material, layer_count), .count = 16, .table = &LAYER_TABLE,
     .doc = "Layers of other materials on this one, from the lowest to the topmost."},
    {KEY_OF(Material, pattern_scale, "pattern_scale", KEY_FLOAT), .kinds = BUMPED | FILM,
     .high = 1e6, .unit = "m",
     .doc = "Wavelength of the pattern's largest features; 0 = the pattern's default."},
    {KEY_OF(Material, pattern_depth, "pattern_depth", KEY_FLOAT), .kinds = BUMPED, .high = 1e3,
     .unit = "m", .doc = "Height of the pattern's bumps; 0 = none."},
    {KEY_OF(Material, wind, "wind", KEY_FLOAT), .kinds = BIT(MATERIAL_WATER), .high = 30,
     .unit = "m/s",
     .doc = "Speed of the wind 10 m above a lake, pond or river, which ripples it in patches: 1 a "
            "breath, 2 light air, 4 a breeze; 0 = none. Ripples below a pixel blur what the water "
            "mirrors. pattern_scale is then the length of the longest; 0 = those that the wind "
            "raises over 1 km. Not of a sea, which has waves of its own."},
    {KEY_OF(Material, wind_azimuth, "wind_azimuth", KEY_FLOAT), .kinds = BIT(MATERIAL_WATER),
     .low = -360, .high = 360, .unit = "degrees",
     .doc = "Where that wind comes from, clockwise from north (-z)."},
    {KEY_OF(Material, calm, "calm", KEY_FLOAT), .kinds = BIT(MATERIAL_WATER), .high = 1,
     .doc = "Share of the water that the gusts of that wind leave nearly still, as a mirror: 0 = "
            "all is rippled, 1 = all is still."},
    {KEY_OF(Material, gusts, "gusts", KEY_FLOAT), .kinds = BIT(MATERIAL_WATER), .high = 1e5,
     .unit = "m",
     .doc = "Size of the largest patches, still and rippled, across the wind; smaller "
            "ones lie at their edges. 0 = 90 m."},
    {KEY_OF(Material, displacement, "displacement", KEY_ENUM), .kinds = PATTERNED,
     .names = DISPLACEMENTS,
     .doc = "Is the relief true geometry near the camera? auto: of barks, stone, "
            "masonry, rubble, dressed stone and "
            "displacement_texture; on: of the patterns noise, strata, mountain, alps, coast, "
            "karst, badlands and snow, too; off: bumps everywhere. Meshes that "
            "are drawn once are diced to about 1.5 pixels (5 x render.detail) where the camera "
            "sees the relief; copies of an object keep bumps."},
    {KEY_OF(Material, moss, "moss", KEY_FLOAT), .kinds = PATTERNED, .high = 1,
     .doc = "Patterns bark, stone, masonry, rubble and dressed: how much moss grows on it: at the "
            "foot, on "
            "sides that face up or north (-z), in furrows and joints first. Pattern mountain: how "
            "damp its faces are: moss in cracks, on ledges and where water seeps, algae, rust and "
            "lime in streaks. Reef: how much of it is dead, under turf."},
    {KEY_OF(Material, lichen, "lichen", KEY_FLOAT), .kinds = PATTERNED, .high = 1,
     .doc = "Patterns bark, stone, masonry, rubble and dressed: how much lichen grows on it; reef: "
            "how much of its dead patches and undersides is pink with coralline algae."},
    {KEY_OF(Material, scars, "scars", KEY_FLOAT), .kinds = PATTERNED, .high = 1,
     .doc = "Pattern bark: how many knots and scars of shed limbs it has; reef: how many bites of "
            "parrotfish; snow: how many of the tracks of a fox there are, at most one in 11 m."},
    {KEY_OF(Material, ribs, "ribs", KEY_FLOAT), .kinds = PATTERNED, .high = 1,
     .doc = "Pattern bark: depth of ribs along a thick stem, 1 = half of its radius; only where it "
            "is displaced; snow: how deep the wind has cut sastrugi into it, 1 = 0.2 of "
            "pattern_depth; 0 = not at all."},
    {KEY_OF(Material, hollows, "hollows", KEY_FLOAT), .kinds = PATTERNED, .high = 1,
     .doc = "Pattern bark: how many holes rot has left in a thick stem; deep only where it is "
            "displaced."},
    {KEY_OF(Material, twist, "twist", KEY_FLOAT), .kinds = PATTERNED, .low = -3600, .high = 3600,
     .unit = "degrees/m", .doc = "Pattern bark: turn of the grain about the stem."},
    {KEY_OF(Material, bark_height, "bark_height", KEY_FLOAT), .kinds = PATTERNED, .high = 100,
     .unit = "m",
     .doc =
         "Bark plates and birch: how far old bark reaches up from the foot, along the wood: thick "
         "plates, with thin flakes above; the black cork of a birch, with diamonds above. 0 = as "
         "far as the stem is thick enough."},
    {KEY_OF(Material, veins, "veins", KEY_FLOAT), .kinds = PATTERNED, .high = 60,
     .doc = "Pattern leaf: side veins on each half of a blade, lobe or leaflet; 0 = veins that run "
            "along it, as of grasses, palms, ginkgo."},
    {KEY_OF(Material, rays, "rays", KEY_FLOAT), .kinds = PATTERNED, .high = 60,
     .doc =
         "Pattern leaf: veins that radiate from the stalk's end of a pad (leaves.shape) and fork "
         "toward its rim, in place of a midrib and its side veins; 0 = none do."},
    {KEY_OF(Material, pale_veins, "pale_veins", KEY_FLOAT), .kinds = PATTERNED, .high = 1,
     .doc = "Pattern leaf: how much paler than the blade its veins are from above, with a light "
            "band along them: 0 = little, 1 = nearly white, as on old ivy."},
    {KEY_OF(Material, mortar, "mortar", KEY_COLOR), .kinds = PATTERNED, .high = 1,
     .doc = "Pattern rubble: reflectance of the mortar, before dirt and algae."},
    {KEY_OF(Material, cracks, "cracks", KEY_FLOAT), .kinds = PATTERNED, .high = 1,
     .doc = "Pattern badlands: how far its clay has swollen and dried: on slopes popcorn, polygons "
            "of two decimetres that break into crumbs down to a centimetre; on washes plates "
            "with curled edges. Their size is natural, whatever pattern_scale; they need a "
            "pattern_depth and, to be true geometry, displacement."},
    {KEY_OF(Material, snow_line, "snow_line", KEY_FLOAT), .kinds = PATTERNED, .high = 1,
     .doc = "Pattern mountain: altitude above which snow lies, as a fraction of the relief; 0 = no "
            "snow."},
    {KEY_OF(Material, grass_line, "grass_line", KEY_FLOAT), .kinds = PATTERNED, .high = 1,
     .doc = "Pattern mountain: altitude below which grass grows, as a fraction of the relief; 0 = "
            "no grass."},
    {KEY_OF(Material, variation, "variation", KEY_FLOAT), .kinds = PATTERNED, .high = 1,
     .doc = "Variation of hue and brightness between instances."},
    {KEY_OF(Material, texture, "texture", KEY_FILE), .kinds = PATTERNED,
     .doc = "Image that multiplies color (and a leaf's transmittance)."},
    {KEY_OF(Material, alpha_texture, "alpha_texture", KEY_FILE), .kinds = COLOURED & ~FILM,
     .doc = "Image used as an opacity mask (cut-out), mapped by the mesh's UVs."},
    {KEY_OF(Material, normal_texture, "normal_texture", KEY_FILE), .kinds = BUMPED,
     .doc = "Image of tangent-space normals: red along u, green along v (up), blue out of the "
            "surface."},
    {KEY_OF(Material, roughness_texture, "roughness_texture", KEY_FILE),
     .kinds = BIT(MATERIAL_PRINCIPLED) | BIT(MATERIAL_LEAF) | BIT(MATERIAL_CONDUCTOR),
     .doc = "Image whose first channel multiplies roughness; not of a metal of roughness 0."},
    {KEY_OF(Material, transmittance_texture, "transmittance_texture", KEY_FILE),
     .kinds = BIT(MATERIAL_LEAF), .doc = "Image that multiplies a leaf's transmittance."},
    {KEY_OF(Material, displacement_texture, "displacement_texture", KEY_FILE), .kinds = PATTERNED,
     .doc = "Image whose first channel is the height of the surface: grey 0.5 leaves it where it "
            "is. True geometry near the camera (displacement), bumps elsewhere."},
    {KEY_OF(Material, displacement_depth, "displacement_depth", KEY_FLOAT), .kinds = PATTERNED,
     .high = 1e3, .unit = "m", .doc = "Height of white over black in displacement_texture."},
    {KEY_OF(Material, texture_mapping, "texture_mapping", KEY_ENUM), .kinds = BUMPED,
     .names = MAPPINGS,
     .doc = "How images, but alpha_texture, are laid on the surface. uv: by its UVs; triplanar: "
            "along the three axes of the object's own space, mixed where it is slanted; auto: by "
            "UVs where it has them, else triplanar."},
    {KEY_OF(Material, texture_scale, "texture_scale", KEY_FLOAT), .kinds = BUMPED, .high = 1e6,
     .unit = "m",
     .doc = "Size of the images on the surface: by UVs in their units (metres on branches, the "
            "whole on most imported meshes), else in metres; 0 = 1."},
    {0},
};

static void material_defaults(const Node *given, int kind, void *out)
{
    Material *material = out;
    const char *name = node_get_text(given, "name");
    const Material *builtin = name ? builtin_material(name) : NULL;
    if (builtin && (kind < 0 || builtin->kind == (MaterialKind)kind)) {
        *material = *builtin;
    } else {
        *material = material_default(kind < 0 ? MATERIAL_DIFFUSE : (MaterialKind)kind);
    }
}

static bool check_material(const Mapping *mapping, void *params)
{
    const Material *material = params;
    if (strchr(material->name, '/') && !builtin_material(material->name)) {
        return mapping_fail(mapping, "name",
                            " has a slash, as built-in materials' names may have and others may "
                            "not; use another character");
    }
    return check_color_stops(mapping, material->colors, material->color_count);
}

const Table material_table = {
    .name = "material",
    .doc = "A surface material. Objects refer to materials by name.",
    .example = "materials:\n"
               "  - {name: leaf, color: \"#7d8a3c\"}                               # the built-in "
               "leaf in autumn\n"
               "  - {name: gold, kind: conductor, color: [1.0, 0.71, 0.29], roughness: 0.2}\n"
               "objects:\n"
               "  - name: ball\n"
               "    material: gold\n"
               "    shape: {envelope: [{shape: sphere, size: 1, position: [0, 1, 0]}]}\n",
    .size = sizeof(Material),
    .keys = MATERIAL_KEYS,
    .kind_key = "kind",
    .kind_defaults = material_defaults,
    .check = check_material};
