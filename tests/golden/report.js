// The report page as a browser shows it. usage: node report.js PAGE.html RESULTS.json
// Prints "ok NAME" or "not ok NAME: why" for each case. RAMIFY_PEERS names the folder of node_modules.
"use strict";
const fs = require("fs");
const { chromium } = require(process.env.RAMIFY_PEERS + "/node_modules/playwright-core");

const [page_file, json_file] = process.argv.slice(2);
const results = JSON.parse(fs.readFileSync(json_file, "utf8"));

function check(name, good, why) {
    console.log(good ? "ok " + name : "not ok " + name + ": " + why);
}

// Every number of the page that the JSON has too.
async function check_numbers(page) {
    const wrong = [];
    let compared = 0;
    for (const scene of results.scenes.filter((s) => s.rmse !== undefined)) {
        const section = page.locator("section", { has: page.locator("h2", { hasText: new RegExp("^" + scene.name + "$") }) });
        for (const [key, value] of Object.entries(scene)) {
            const field = section.locator(`dd[data-key="${key}"]`);
            if (typeof value !== "number" || (await field.count()) === 0) continue;
            const shown = parseFloat(await field.innerText());
            const wanted = key === "failing" ? 100 * value : value;
            compared++;
            if (Math.abs(shown - wanted) > 2e-5 * Math.abs(wanted)) wrong.push(`${scene.name} ${key}: ${shown}, not ${wanted}`);
        }
    }
    check("report_numbers_are_those_of_the_json", compared > 8 && wrong.length === 0, compared + " compared; " + wrong.join("; "));
}

async function check_pictures(page) {
    const bad = await page.$$eval("img", (images) => images.filter((i) =>
        !i.complete || i.naturalWidth !== Number(i.getAttribute("width")) || i.naturalHeight !== Number(i.getAttribute("height")) || !i.alt).map((i) => i.alt));
    const count = await page.locator("img").count();
    check("report_pictures_are_whole_and_described", count > 4 && bad.length === 0, count + " pictures; " + bad.join("; "));
}

const cut_of = (pair) => pair.locator("img.ours").evaluate((image) => getComputedStyle(image).clipPath);

async function check_slider(page) {
    const pair = page.locator(".pair").first();
    await pair.scrollIntoViewIfNeeded();
    const box = await pair.boundingBox();
    const y = box.y + box.height / 2;
    await page.mouse.move(box.x + box.width / 2, y);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width * 0.25, y, { steps: 5 });
    await page.mouse.up();
    const dragged = Number(await pair.locator("input").inputValue());
    const clip = await cut_of(pair);
    check("report_slider_follows_the_mouse", Math.abs(dragged - 25) < 3 && (clip.includes(`calc(100% - ${dragged}%)`) || clip.includes(`${100 - dragged}%`)), `at ${dragged}: ${clip}`);
    await pair.locator("input").focus();
    for (let i = 0; i < 10; i++) await page.keyboard.press("ArrowRight");
    const keyed = Number(await pair.locator("input").inputValue());
    check("report_slider_follows_the_keyboard", Math.abs(keyed - dragged - 5) < 0.01 && (await cut_of(pair)) !== clip, `from ${dragged} to ${keyed}`);
    await page.getByRole("button", { name: "Flip" }).first().click();
    const flipped = await pair.locator("input").inputValue();
    check("report_flips", flipped === "100", "to " + flipped);
}

// A finger on a small screen.
async function check_touch(browser) {
    const context = await browser.newContext({ hasTouch: true, isMobile: true, viewport: { width: 412, height: 800 } });
    const page = await context.newPage(), session = await context.newCDPSession(page);
    await page.goto("file://" + page_file);
    const pair = page.locator(".pair").first();
    await pair.scrollIntoViewIfNeeded();
    const box = await pair.boundingBox();
    const touch = (type, share) => session.send("Input.dispatchTouchEvent", { type,
        touchPoints: share === null ? [] : [{ x: box.x + share * box.width, y: box.y + box.height / 2 }] });
    await touch("touchStart", 0.5);
    for (const share of [0.6, 0.7, 0.8]) await touch("touchMove", share);
    await touch("touchEnd", null);
    await page.waitForTimeout(100);
    const value = Number(await pair.locator("input").inputValue());
    check("report_slider_follows_the_finger", Math.abs(value - 80) < 4, "at " + value);
    const over = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
    check("report_fits_a_small_screen", over <= 0, over + " pixels too wide");
    await context.close();
}

async function check_zoom(page) {
    const image = page.locator("img.plain").first();
    const natural = await image.evaluate((i) => i.naturalWidth);
    await page.selectOption("#zoom", "4");
    const width = await image.evaluate((i) => i.getBoundingClientRect().width);
    const rendering = await image.evaluate((i) => getComputedStyle(i).imageRendering);
    check("report_zooms_pixels", Math.abs(width - 4 * natural) < 0.5 && rendering === "pixelated", `${natural} to ${width}, ${rendering}`);
}

async function check_order(page) {
    const classes = await page.$$eval("section", (sections) => sections.map((s) => s.className));
    const first_alike = classes.indexOf("alike");
    check("report_shows_failures_first", first_alike > 0 && classes.slice(first_alike).every((c) => c === "alike"), classes.join(" "));
    await page.check("#only");
    const seen = await page.locator("section:visible").count();
    check("report_hides_what_is_alike", seen === first_alike, seen + " of " + classes.length);
}

(async () => {
    const browser = await chromium.launch({
        executablePath: "/usr/bin/chromium",
        args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
            "--disable-component-update", "--disable-sync"],
    });
    const page = await browser.newPage();
    const complaints = [], requests = [];
    page.on("console", (message) => complaints.push(message.text()));
    page.on("pageerror", (error) => complaints.push(error.message));
    page.on("request", (request) => request.url().startsWith("data:") || requests.push(request.url()));
    await page.goto("file://" + page_file);
    await check_pictures(page);
    await check_numbers(page);
    await check_slider(page);
    await check_touch(browser);
    await check_zoom(page);
    await check_order(page);
    const injected = await page.locator("section b").count();
    check("report_names_are_text", injected === 0, injected + " elements came from a name");
    check("report_asks_nobody", requests.length === 1, requests.join(" "));
    check("report_without_complaints", complaints.length === 0, complaints.join("; "));
    await browser.close();
})().catch((error) => {
    console.log("not ok report_in_a_browser: " + error.message.split("\n")[0]);
    process.exit(1);
});
