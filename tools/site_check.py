#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Opens every page of the site in headless Chromium, by site_check.html, and prints what is wrong.

Usage: tools/site_check.py FOLDER     exit status 0: nothing is
"""
import functools
import http.server
import json
import pathlib
import subprocess
import sys
import tempfile
import threading

folder = pathlib.Path(sys.argv[1])
# The pages of the headers are many, and linkchecker reads them.
pages = sorted(str(page.relative_to(folder)) for page in folder.rglob("*.html")
               if not page.relative_to(folder).parts[0] == "api")
checker = pathlib.Path(__file__).with_name("site_check.html").read_text().replace("PAGES", json.dumps(pages))
said = []
is_said = threading.Event()


class Handler(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass

    def do_GET(self):
        if self.path != "/check":
            super().do_GET()
            return
        self.send_response(200)
        self.send_header("Content-Type", "text/html; charset=utf-8")
        self.end_headers()
        self.wfile.write(checker.encode())

    def do_POST(self):
        said.append(self.rfile.read(int(self.headers["Content-Length"])).decode())
        self.send_response(204)
        self.end_headers()
        is_said.set()


server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=folder))
threading.Thread(target=server.serve_forever, daemon=True).start()
with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
    browser = subprocess.Popen(
        ["chromium", "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={profile}",
         "--window-size=1280,1024", "--remote-debugging-port=0", f"http://127.0.0.1:{server.server_port}/check"],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    is_said.wait(timeout=600)
    browser.terminate()
    browser.wait()
print(said[0] if said else "wrong: Chromium said nothing in ten minutes", end="")
sys.exit(not (said and said[0].startswith("right: ")))
