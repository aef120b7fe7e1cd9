import { chromium } from "playwright-core";
const address = process.argv[2];
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox","--use-gl=angle","--use-angle=swiftshader","--enable-unsafe-swiftshader"] });
for (let i=0;i<3;i++){
const tab = await browser.newPage({ viewport: { width: 1280, height: 800 } });
let last=[]; const t0=Date.now();
tab.on("response", a => { const u=new URL(a.url()); if(u.pathname.startsWith("/api")) last.push([u.pathname+u.search.slice(0,40), Date.now()-t0, a.headers()["x-triangles"]]); });
await tab.goto(address);
await tab.waitForTimeout(4000);
console.log(JSON.stringify(last.slice(0,8)), await tab.evaluate(()=>JSON.stringify(performance.getEntriesByType("paint").map(e=>[e.name,Math.round(e.startTime)]))));
await tab.screenshot({path:"/tmp/lw/v/b.png"}); await tab.close(); }
await browser.close();
