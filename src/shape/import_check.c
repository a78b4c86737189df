#include "shape/import_check.h"

#include "base/file_name.h"
#include "shape/import_read.h"

#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#define COUNT_LIMIT 1000000000.0 // most vertices or faces that a file may declare

static bool check_extension(const char *file, Error *e)
{
    static const char *const known[] = {".obj", ".ply", ".stl", ".gltf", ".glb", ".vdb"};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (strcasecmp(file_name_ending(file), known[i]) == 0) {
            return true;
        }
    }
    return error_set(e, ERROR_INPUT,
                     "the name does not end in a mesh format that can be read; .obj, .ply, .stl, "
                     ".gltf, .glb or .vdb would be right");
}

// ---- PLY ----

typedef enum PlyFormat { PLY_NONE, PLY_ASCII, PLY_BINARY } PlyFormat;

// What a PLY header declares.
typedef struct PlyHeader {
    PlyFormat format;
    double elements, vertices, faces; // counts; double, so that absurd ones fit
    double bytes;                     // least size of the binary body
    bool in_face;                     // the properties that follow belong to a face
} PlyHeader;

static double ply_type_size(const char *type)
{
    static const struct {
        const char *name;
        double size;
    } types[] = {{"char", 1},   {"uchar", 1},   {"int8", 1},   {"uint8", 1},
                 {"short", 2},  {"int16", 2},   {"ushort", 2}, {"uint16", 2},
                 {"double", 8}, {"float64", 8}, {"int", 4},    {"uint", 4},
                 {"int32", 4},  {"uint32", 4},  {"float", 4},  {"float32", 4}};
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
        if (strcmp(type, types[i].name) == 0) {
            return types[i].size;
        }
    }
    return 1;
}

// Parses one header line; *count is the count of the element whose properties follow.
static void ply_line(const char *line, PlyHeader *header, double *count)
{
    char a[32] = "", b[32] = "", c[32] = "", d[32] = "", name[32] = "";
    int words = sscanf(line, "%31s %31s %31s %31s %31s", a, b, c, d, name);
    if (words >= 2 && strcmp(a, "format") == 0) {
        header->format = strcmp(b, "ascii") == 0 ? PLY_ASCII : PLY_BINARY;
    } else if (words >= 3 && strcmp(a, "element") == 0) {
        *count = 0;
        if (sscanf(c, "%lf", count) != 1 || !(*count >= 0)) {
            *count = 0;
        }
        header->elements += *count;
        header->in_face = strcmp(b, "face") == 0;
        if (strcmp(b, "vertex") == 0) {
            header->vertices = *count;
        } else if (header->in_face) {
            header->faces = *count;
        }
    } else if (words >= 4 && strcmp(a, "property") == 0 && strcmp(b, "list") == 0) {
        // a face has at least three corners; other lists may be empty
        double items = header->in_face && strncmp(name, "vertex_ind", 10) == 0 ? 3 : 0;
        header->bytes += *count * (ply_type_size(c) + items * ply_type_size(d));
    } else if (words >= 3 && strcmp(a, "property") == 0) {
        header->bytes += *count * ply_type_size(b);
    }
}

// Reads the header and leaves the stream at the body; false when the header does not end.
static bool ply_header(FILE *stream, PlyHeader *header)
{
    char line[1024];
    double count = 0;
    *header = (PlyHeader){.format = PLY_NONE};
    for (int n = 0; n < 4096 && fgets(line, sizeof line, stream); n++) {
        if (n == 0 && strncmp(line, "ply", 3) != 0) {
            return false;
        }
        if (strncmp(line, "end_header", 10) == 0) {
            return header->format != PLY_NONE;
        }
        ply_line(line, header, &count);
    }
    return false;
}

// Counts the non-empty lines from here to the end.
static double count_lines(FILE *stream)
{
    char block[65536];
    double lines = 0;
    bool filled = false;
    size_t n;
    while ((n = fread(block, 1, sizeof block, stream)) > 0) {
        for (size_t i = 0; i < n; i++) {
            if (block[i] == '\n') {
                lines += filled ? 1 : 0;
                filled = false;
            } else if (block[i] != ' ' && block[i] != '\r' && block[i] != '\t') {
                filled = true;
            }
        }
    }
    return lines + (filled ? 1 : 0);
}

static bool check_ply(FILE *stream, int64_t size, Error *e)
{
    PlyHeader header;
    if (!ply_header(stream, &header)) {
        return error_set(e, ERROR_INPUT,
                         "not a PLY file, or its header is cut off; a header from "
                         "'ply' to 'end_header' is needed");
    }
    if (header.vertices > COUNT_LIMIT || header.faces > COUNT_LIMIT) {
        return error_set(e, ERROR_INPUT,
                         "the header promises %.0f vertices and %.0f faces; at most %.0f of each "
                         "are possible",
                         header.vertices, header.faces, COUNT_LIMIT);
    }
    double promised = header.format == PLY_ASCII ? header.elements : header.bytes;
    double found =
        header.format == PLY_ASCII ? count_lines(stream) : (double)size - (double)ftell(stream);
    if (found < promised) {
        return error_set(e, ERROR_INPUT,
                         "truncated: the header promises %.0f vertices and %.0f faces, which need "
                         "%.0f %s, but %.0f follow; the whole file is needed",
                         header.vertices, header.faces, promised,
                         header.format == PLY_ASCII ? "lines" : "bytes", found);
    }
    return true;
}

// ---- STL ----

// A binary STL has 80 bytes of comment, a count and 50 bytes per facet; a text STL starts with
// "solid" (as some binary ones do) and ends with "endsolid".
static bool check_stl(FILE *stream, int64_t size, Error *e)
{
    unsigned char head[84] = {0};
    size_t got = fread(head, 1, sizeof head, stream);
    uint32_t count = (uint32_t)head[80] | (uint32_t)head[81] << 8 | (uint32_t)head[82] << 16 |
                     (uint32_t)head[83] << 24;
    double promised = 84.0 + 50.0 * (double)count;
    if (got == sizeof head && (double)size == promised) {
        return true;
    }
    if (strncasecmp((const char *)head, "solid", 5) == 0) {
        char tail[257] = "";
        if (fseek(stream, size > 256 ? -256 : -(long)size, SEEK_END) == 0) {
            tail[fread(tail, 1, 256, stream)] = '\0';
        }
        return strcasestr(tail, "endsolid") ||
               error_set(e, ERROR_INPUT,
                         "truncated: no 'endsolid' at its end; the whole STL file is needed");
    }
    return (got == sizeof head && (double)size > promised) ||
           error_set(e, ERROR_INPUT,
                     "truncated: the header promises %u facets, which need %.0f bytes, but the "
                     "file has %lld; the whole STL file is needed",
                     count, promised, (long long)size);
}

// Whether any line begins with an f: only faces have an area in an OBJ file.
static bool check_obj(FILE *stream, Error *e)
{
    bool at_start = true; // of a line, ignoring blanks
    for (int c = getc_unlocked(stream); c != EOF; c = getc_unlocked(stream)) {
        bool blank = c == ' ' || c == '\t';
        if (at_start && c == 'f') {
            c = getc_unlocked(stream);
            if (c == ' ' || c == '\t') {
                return true;
            }
        }
        at_start = c == '\n' || c == '\r' || (at_start && blank);
    }
    return error_set(e, ERROR_INPUT, IMPORT_NO_TRIANGLES);
}

// An OpenVDB file begins with its magic number, as 64 bits.
static bool check_vdb(FILE *stream, Error *e)
{
    static const unsigned char magic[8] = {0x20, 'B', 'D', 'V'};
    unsigned char head[8] = {0};
    bool whole = fread(head, 1, sizeof head, stream) == sizeof head;
    return (whole && memcmp(head, magic, sizeof magic) == 0) ||
           error_set(e, ERROR_INPUT,
                     "not an OpenVDB file: its first bytes are others; a whole "
                     ".vdb file is needed");
}

static bool check_contents(FILE *stream, const char *file, int64_t size, Error *e)
{
    if (size == 0) {
        return error_set(e, ERROR_INPUT, "the file is empty; a mesh is needed");
    }
    if (strcasecmp(file_name_ending(file), ".ply") == 0) {
        return check_ply(stream, size, e);
    }
    if (strcasecmp(file_name_ending(file), ".stl") == 0) {
        return check_stl(stream, size, e);
    }
    if (strcasecmp(file_name_ending(file), ".vdb") == 0) {
        return check_vdb(stream, e);
    }
    return strcasecmp(file_name_ending(file), ".obj") != 0 || check_obj(stream, e);
}

bool import_check(const char *file, Error *e)
{
    struct stat status;
    if (!file || !file[0]) {
        return error_set(e, ERROR_INPUT, "no mesh file is named; give the path of one");
    }
    if (stat(file, &status) != 0) {
        return error_set(e, ERROR_INPUT, "cannot be read: %s; give the path of a mesh file",
                         strerror(errno));
    }
    if (!S_ISREG(status.st_mode)) {
        return error_set(e, ERROR_INPUT, "is not a file; give the path of a mesh file");
    }
    if (!check_extension(file, e)) {
        return false;
    }
    FILE *stream = fopen(file, "rb");
    if (!stream) {
        return error_set(e, ERROR_INPUT, "cannot be read: %s; give the path of a mesh file",
                         strerror(errno));
    }
    bool right = check_contents(stream, file, (int64_t)status.st_size, e);
    fclose(stream);
    return right;
}
