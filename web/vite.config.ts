// One file without references: scripts and styles are written into the page, so that it opens from disk and can be sent by mail.
import { defineConfig, type Plugin } from "vite";

function intoOneFile(): Plugin {
  return {
    name: "into-one-file",
    enforce: "post",
    generateBundle(_options, bundle) {
      const page = Object.values(bundle).find((file) => file.fileName.endsWith(".html"));
      if (!page || page.type !== "asset") throw new Error("no page was built");
      let html = String(page.source);
      for (const file of Object.values(bundle)) {
        if (file === page) continue;
        if (file.type === "chunk") {
          html = html.replace(/<script[^>]*\bsrc="[^"]*"[^>]*><\/script>/, "");
          html = html.replace("</body>", () => `<script type="module">${file.code.replaceAll("</script", "<\\/script")}</script>\n</body>`);
        } else if (file.fileName.endsWith(".css")) {
          html = html.replace(/<link rel="stylesheet"[^>]*>/, () => `<style>${String(file.source)}</style>`);
        }
        delete bundle[file.fileName];
      }
      page.source = html;
    },
  };
}

export default defineConfig({
  base: "./",
  build: {
    outDir: "dist",
    target: "es2022",
    modulePreload: false,
    assetsInlineLimit: 1 << 20,
    cssCodeSplit: false,
    rollupOptions: { input: `${process.env.PAGE ?? "atlas"}.html` },
  },
  plugins: [intoOneFile()],
  server: { host: "127.0.0.1" }, // of the tests: no name need be known
  // Limits are for what hangs: a busy machine draws slowly. One file after the other: each has a browser that takes all processors.
  test: {
    include: ["tests/**/*.test.ts"],
    testTimeout: 240_000,
    hookTimeout: 240_000,
    fileParallelism: false,
    expect: { poll: { timeout: 60_000 } },
  },
} as Parameters<typeof defineConfig>[0]);
