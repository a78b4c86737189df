// What every report begins with: looks and behaviour of the page (report_page.c).
#ifndef RAMIFY_GOLDEN_REPORT_PAGE_H
#define RAMIFY_GOLDEN_REPORT_PAGE_H

extern const char *const REPORT_STYLE;  // CSS
extern const char *const REPORT_SCRIPT; // JavaScript

#endif
