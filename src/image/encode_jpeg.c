// libjpeg's error handler may not return: it leaves by longjmp, to the function that called
// libjpeg; those functions change no variable of their own after setjmp.
#include "image/encode_jpeg.h"

#include "base/memory.h"

#include <setjmp.h>
#include <stdio.h> // jpeglib.h needs it

#include <jerror.h>
#include <jpeglib.h>
#include <stdlib.h>
#include <string.h>

enum { QUALITY = 95, MAX_COMMENT = 30000, ROOM = 1 << 16 };

// The mean difference of a row, in steps of 8 bits. White noise has 3 at this quality.
static const double MOST_DIFFERENCE = 16.0;

typedef struct Failure {
    struct jpeg_error_mgr manager; // first: libjpeg knows no more
    jmp_buf back;
    Error *e;
} Failure;

static void fail(j_common_ptr jpeg)
{
    Failure *failure = (Failure *)jpeg->err;
    char message[JMSG_LENGTH_MAX];
    jpeg->err->format_message(jpeg, message);
    bool memory = jpeg->err->msg_code == JERR_OUT_OF_MEMORY;
    error_set(failure->e, memory ? ERROR_MEMORY : ERROR_INTERNAL, "%s",
              memory ? "out of memory" : message);
    longjmp(failure->back, 1);
}

static void ignore(j_common_ptr jpeg)
{
    (void)jpeg;
}

static struct jpeg_error_mgr *set_failure(Failure *failure, Error *e)
{
    jpeg_std_error(&failure->manager);
    failure->manager.error_exit = fail;
    failure->manager.output_message = ignore;
    failure->e = e;
    return &failure->manager;
}

// ---- writing

// Where libjpeg writes: the room of the file, which grows when it is full.
typedef struct Target {
    struct jpeg_destination_mgr manager; // first: libjpeg knows no more
    Encoded *file;
} Target;

static void make_room(j_compress_ptr jpeg)
{
    Target *target = (Target *)jpeg->dest;
    Encoded *file = target->file;
    if (!encoded_reserve(file, ROOM, NULL)) {
        ERREXIT1(jpeg, JERR_OUT_OF_MEMORY, 0);
    }
    target->manager.next_output_byte = file->bytes + file->size;
    target->manager.free_in_buffer = (size_t)(file->room - file->size);
}

// libjpeg has filled all the room.
static boolean grow(j_compress_ptr jpeg)
{
    Encoded *file = ((Target *)jpeg->dest)->file;
    file->size = file->room;
    make_room(jpeg);
    return TRUE;
}

static void finish(j_compress_ptr jpeg)
{
    Encoded *file = ((Target *)jpeg->dest)->file;
    file->size = file->room - (int64_t)jpeg->dest->free_in_buffer;
}

// The pairs of metadata as lines: JPEG has no free attributes. The caller frees it.
static char *comment_of(const char *metadata, Error *e)
{
    char *text = memory_alloc_zero(MAX_COMMENT + 1, 1, e);
    size_t length = 0;
    for (const char *key = metadata; text && key && *key && length < MAX_COMMENT;) {
        const char *value = key + strlen(key) + 1;
        int more = snprintf(text + length, MAX_COMMENT + 1 - length, "%s: %s\n", key, value);
        length += more > 0 ? (size_t)more : 0;
        key = value + strlen(value) + 1;
    }
    return text;
}

static void set_parameters(j_compress_ptr jpeg, const Raster *raster)
{
    jpeg->image_width = (JDIMENSION)raster->width;
    jpeg->image_height = (JDIMENSION)raster->height;
    jpeg->input_components = 3;
    jpeg->in_color_space = JCS_RGB;
    jpeg_set_defaults(jpeg);
    jpeg_set_quality(jpeg, QUALITY, TRUE);
    jpeg->optimize_coding = TRUE;
    for (int c = 0; c < jpeg->num_components; c++) { // 4:4:4
        jpeg->comp_info[c].h_samp_factor = jpeg->comp_info[c].v_samp_factor = 1;
    }
}

static bool write_all(j_compress_ptr jpeg, Failure *failure, const Raster *raster,
                      const char *comment)
{
    if (setjmp(failure->back)) {
        return false;
    }
    set_parameters(jpeg, raster);
    jpeg_start_compress(jpeg, TRUE);
    if (comment[0]) {
        jpeg_write_marker(jpeg, JPEG_COM, (const JOCTET *)comment, (unsigned)strlen(comment));
    }
    while (jpeg->next_scanline < jpeg->image_height) {
        JSAMPROW row = (JSAMPROW)(uintptr_t)raster_row(raster, (int)jpeg->next_scanline);
        jpeg_write_scanlines(jpeg, &row, 1);
    }
    jpeg_finish_compress(jpeg);
    return true;
}

static bool create_writer(j_compress_ptr jpeg, Failure *failure)
{
    if (setjmp(failure->back)) {
        return false;
    }
    jpeg_create_compress(jpeg);
    return true;
}

static bool write_file(const Raster *raster, const char *comment, Encoded *file, Error *e)
{
    Failure failure;
    struct jpeg_compress_struct jpeg = {.err = set_failure(&failure, e)};
    Target target = {.manager = {.init_destination = make_room,
                                 .empty_output_buffer = grow,
                                 .term_destination = finish},
                     .file = file};
    bool done = create_writer(&jpeg, &failure);
    if (done) {
        jpeg.dest = &target.manager;
        done = write_all(&jpeg, &failure, raster, comment);
    }
    jpeg_destroy_compress(&jpeg);
    return done;
}

// ---- reading it again

static bool is_alike(const unsigned char *wanted, const unsigned char *found, size_t size)
{
    double sum = 0.0;
    for (size_t i = 0; i < size; i++) {
        sum += abs(wanted[i] - found[i]);
    }
    return sum <= MOST_DIFFERENCE * (double)size;
}

// row: memory for one row.
static bool is_same(j_decompress_ptr jpeg, Failure *failure, const Raster *raster,
                    const Encoded *file, bool comment, unsigned char *row)
{
    if (setjmp(failure->back)) {
        return false;
    }
    jpeg_create_decompress(jpeg);
    jpeg_mem_src(jpeg, file->bytes, (unsigned long)file->size);
    jpeg_save_markers(jpeg, JPEG_COM, 0xffff);
    jpeg_read_header(jpeg, TRUE);
    jpeg_start_decompress(jpeg);
    bool same = jpeg->output_width == (JDIMENSION)raster->width &&
                jpeg->output_height == (JDIMENSION)raster->height && jpeg->output_components == 3 &&
                (jpeg->marker_list || !comment);
    while (same && jpeg->output_scanline < jpeg->output_height) {
        int y = (int)jpeg->output_scanline;
        jpeg_read_scanlines(jpeg, &row, 1);
        same = is_alike(raster_row(raster, y), row, raster_row_bytes(raster));
    }
    return same && jpeg->err->num_warnings == 0;
}

static bool check_file(const Raster *raster, bool comment, const Encoded *file, Error *e)
{
    Failure failure;
    struct jpeg_decompress_struct jpeg = {.err = set_failure(&failure, NULL)};
    unsigned char *row = memory_alloc((int64_t)raster_row_bytes(raster), 1, NULL);
    bool done = row && is_same(&jpeg, &failure, raster, file, comment, row);
    jpeg_destroy_decompress(&jpeg);
    free(row);
    return done || error_set(e, ERROR_MEMORY, "what was written is not complete; out of memory");
}

bool encode_jpeg(const Raster *raster, Encoded *file, Error *e)
{
    char *comment = comment_of(raster->metadata, e);
    bool done =
        comment && write_file(raster, comment, file, e) && check_file(raster, comment[0], file, e);
    free(comment);
    return done;
}
